// Ticks the engine from any state of a run, with any answers of its leaves: one for each thread.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "base/core/deadlines.h"
#include "leaves/model_leaf.h"
#include "verify/barrier_watch.h"
#include "verify/joint_answers.h"
#include "verify/property_watch.h"
#include "verify/read_parameters.h"
#include "verify/rounds.h"
#include "verify/search_limits.h"
#include "verify/state_code.h"
#include "verify/tick_answers.h"
#include "verify/tick_points.h"

namespace lockstep::host {

// Asks whether the process is cut before a tick; 1: it is.
std::uint32_t cut_asker(const Tree& tree, const LeafModels& models);

// A run goes on after a cut, between two ticks: what its leaves do then, as the answers choose.
std::vector<CutLeaf> after_cut(Ticker& ticker, const LeafModels& models, Answers& answers,
                               ModelLeaves& leaves);

class Stepper {
 public:
  // All must outlive this.
  Stepper(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
          double rate, const Symmetry& symmetry, bool rising_answers,
          std::uint64_t few_root_ticks = kFewRootTicks, std::uint64_t few_ticks = kAllTicks,
          bool joins = false);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  // The state before the first tick.
  StateBytes first_state();

  // From this state on. Then `tick` for each combination of answers, until `next` is false.
  void load(std::span<const std::byte> state, bool is_first);
  // In place of combinations: `tick` has these answers, once for each.
  void give(std::span<const LeafAnswer> answers);
  // The root's status; Running also after a fault. What the tick did can be looked at until `fold`.
  // It ticks the root so often at most; if a node then asks for more, it is not done.
  Status tick(std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
  bool is_done() const { return !ticker_.is_asked() && !is_cut_; }
  // What follows is the same as in another tick from this state: it stopped before that.
  bool is_known() const { return is_known_; }
  // `tick` asks it now and then while nodes ask for more: true, and it is not done.
  void set_gives_up(std::function<bool()> gives_up) { gives_up_ = std::move(gives_up); }
  // `tick` calls it when it has ticked the root and is about to tick it again.
  using BeforeTickAgain = std::function<void(ModelLeaves& leaves)>;
  void set_before_tick_again(BeforeTickAgain call) { before_tick_again_ = std::move(call); }
  // The same of a leaf that is ticked once more, without the root.
  void set_before_leaf_again(ModelLeaves::BeforeTickAgain call) {
    leaves_.set_before_tick_again(std::move(call));
  }
  // How often the root was ticked: again if a node has asked for it.
  std::uint64_t root_ticks() const { return root_ticks_; }
  bool next() { return is_joint_ ? joint_.next() : answers_.next(); }
  // The state after a tick, with equal children in one order. Valid until the next call.
  const StateBytes& fold();
  // After that, of each place: the node that had what it has; empty if none has moved.
  std::span<const NodeIndex> origins() const { return code_.origins(); }
  // The same state, with all children where they are.
  const StateBytes& in_place();
  // A state in which each node is at one of these places.
  const StateBytes& moved(std::span<const std::byte> state, std::span<const NodeIndex> places);

  // Those of the last tick, and the leaves that are equal in the state that was loaded.
  const TickAnswers& answers() const { return answers_; }
  // The state that was loaded.
  const SavedRun& before() const { return from_; }
  // Whether the leaf ran in it, or was held.
  bool ran(std::uint32_t leaf) const { return from_leaves_[leaf].runs(); }
  // Whether the process was cut before the last tick. That is the first of its answers.
  bool was_cut() const { return was_cut_; }
  // What the leaves do then that ran.
  std::span<const CutLeaf> cut_leaves() const { return cut_leaves_; }
  Ticker& ticker() { return ticker_; }
  const Ticker& ticker() const { return ticker_; }
  const ModelLeaves& leaves() const { return leaves_; }
  ModelLeaves& leaves() { return leaves_; }
  // The properties that the tick, or the end in it, has violated, by their place.
  std::span<const std::size_t> violated() const { return watch_.violated(); }
  // A barrier that was passed in the tick before all had reached it. Looked at with cuts only.
  std::optional<BarrierWatch::Passed> passed() const {
    return barriers_ ? barriers_->passed() : std::nullopt;
  }
  // Whether a leaf with commit starts again after the cut, although it may have succeeded in the
  // tick that was lost, and its type keeps no state by which it would know.
  bool repeats(const CutLeaf& leaf) const;
  // After `tick`: whether a property still waits for something.
  bool owes(std::size_t property) const { return watch_.owes(property_bytes_.data(), property); }

 private:
  void begin_combinations();
  void begin_joint();
  std::optional<std::vector<JointAnswers::ChildTick>> ticks_of(const JointAnswers::Child& child);
  std::vector<std::byte> marks_of(const JointAnswers::Child& child) const;
  Status tick_again(Status status, std::uint64_t most);
  bool is_cut_here();
  void cut();
  void begin_watching();
  bool look_at_round(NodeIndex asks);
  void make_round_state(NodeIndex asks);
  Status go_round(Status status);
  void fault(NodeIndex asks);

  const Deadlines deadlines_;
  Blackboard board_;
  TickAnswers answers_;
  ModelLeaves leaves_;
  Ticker ticker_;
  PropertyWatch watch_;
  SavedRun fresh_, from_;
  StateCode code_;
  ReadParameters parameters_;
  std::optional<BarrierWatch> barriers_;  // of a search with cuts
  const Symmetry& symmetry_;
  const LeafModels& models_;
  const ProcessCuts cuts_;
  const std::uint32_t cut_asker_;
  bool was_cut_ = false;
  std::vector<CutLeaf> cut_leaves_;
  std::uint8_t from_cuts_ = 0;
  std::vector<LeafState> from_leaves_;
  std::vector<FactState> from_facts_;
  std::vector<ReadValues> from_read_;
  StateBytes property_bytes_, from_properties_;
  Nanoseconds time_{0};
  std::uint64_t root_ticks_ = 0;
  Rounds rounds_;
  TickPoints points_;
  JointAnswers joint_;
  bool is_begun_ = false, is_joint_ = false;  // the state that was loaded
  bool is_known_ = false, is_going_round_ = false, is_short_ = false, is_cut_ = false;
  std::vector<bool> has_gone_round_;  // of each node: there was a fault of it; then of properties
  SavedRun round_;
  std::vector<LeafState> round_leaves_;
  std::vector<FactState> round_facts_;
  StateBytes round_properties_, round_state_;
  BeforeTickAgain before_tick_again_;
  std::function<bool()> gives_up_;
  StateBytes folded_, moved_;
};

}  // namespace lockstep::host
