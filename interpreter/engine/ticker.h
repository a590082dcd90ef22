// Ticks one run of a tree, for the owner of the run: from its start to its last halt. Node kinds
// see the same run as a NodeContext, observers should only read it (RunView). One thread at a time.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/held_leaves.h"
#include "engine/node_context.h"
#include "trace/answer.h"

namespace lockstep::host {

struct RunParts;
struct SavedRun;

class Ticker : public NodeContext {
 public:
  // All must outlive the ticker: `leaves` (one for each Tree::leaves, in order), and the watch of
  // their calls, if there is one.
  Ticker(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board,
         FaultPolicy policy = FaultPolicy::Stop, LeafWatch* watch = nullptr);

  // The time of the next tick, which must not decrease. From now on, progress is computed for that
  // time.
  void set_now(Nanoseconds now) {
    state_.now = now;
    shares_progress_ = false;
    if (watch_ != nullptr) watch_->expect_tick();
  }

  // Ticks the root once, at that time. The result is Running while the tree runs, and after a
  // fault.
  Status tick_root();
  Status tick_root(Nanoseconds now) {
    set_now(now);
    return tick_root();
  }

  // Ticks it once more in the same tick, for a node that has asked for it.
  Status tick_root_again();
  bool is_asked() const { return state_.asked_by != 0; }
  // The node that has asked since the last call, if any.
  std::optional<NodeIndex> take_request() {
    const std::uint32_t node = std::exchange(state_.asked_by, 0);
    return node == 0 ? std::nullopt : std::optional(node - 1);
  }

  // A running node's next tick halts what runs in it and returns Failure, if the next tick of the
  // tree reaches it. It is no fault.
  void fail_next(NodeIndex node);
  // After that tick: takes back what it did not reach. True if the node has failed so.
  bool take_failed(NodeIndex node);

  // Between two ticks: an answer to a node that asks a person, by who has seen the tick with the
  // number `seen`. False: the node did not ask then, does not ask now, or has an answer already.
  struct Answer {
    std::uint32_t option;   // its place among those of the node
    std::string text, who;  // that option; the person
  };
  bool answer(NodeIndex node, Answer given, std::uint32_t seen);
  // Those that no tick has taken yet.
  std::span<const GivenAnswer> waiting_answers() const {
    return answers_of(state_.tick_number + 1);
  }
  // Those that came before the last tick.
  std::span<const GivenAnswer> answers() const { return answers_of(state_.tick_number); }

  // Between two ticks: in the last tick, the leaf did what it must not. The run stops, or it
  // continues (FaultPolicy). Then a running leaf fails in its next tick, and a completed one keeps
  // its result.
  void report_fault(NodeIndex leaf, std::string message);

  // Halts every running leaf. A leaf with a fault in this halt may not have stopped, so the fault
  // becomes that of the run, whatever the policy. If the run already has a fault, tolerated() has
  // the new one.
  void halt_all();

  // After a fault: halts what runs, and the next tick begins the tree.
  void recover();

  // Resets everything without a call to the leaves: call halt_all first.
  void reset();

  const Fault* fault() const { return state_.faulted ? &state_.fault : nullptr; }
  // The faults after which the run goes on, in order, since they were last taken: those of a tick,
  // of progress that was read before it, and of halt_all.
  std::span<const Fault> tolerated() const { return state_.tolerated; }
  std::vector<Fault> take_tolerated() { return std::exchange(state_.tolerated, {}); }
  // In this run, one of each leaf.
  std::span<const OutOfRange> out_of_range() const { return state_.out_of_range; }
  // The same of those that went on while they were held.
  std::span<const WentOn> went_on() const { return held_leaves_.went_on(); }

  // What happens within ticks is kept from now on: for those who watch. Allocates.
  void keep_moments();
  // The same, with the progress of leaves within a tick: for who asks all nodes before each tick.
  void keep_moments_with_progress();
  // Of the last tick. Valid until the next one.
  MomentsView moments() const { return moments_ == nullptr ? MomentsView{} : moments_->view(); }

  // Tells of these nodes, and of no others, while they are ticked; null: of none. Also in a tick.
  void watch_nodes(std::span<const NodeIndex> nodes, NodeWatch* watch);

  // Between two ticks: all of the run but what the leaves keep in themselves. After `restore` the
  // run goes on as it did after `save`. The saved run is one of this ticker, or of another one of
  // the same tree.
  void save(SavedRun& into) const;
  RunParts parts() const;  // for who only reads it
  void restore(const SavedRun& from);
  // What the leaves keep in themselves, of those that can (NodeType::can_be_restored). A leaf that
  // fails in this has a fault. The first call allocates, and what grows.
  void save_leaves(LeafBytes& into);
  // After `restore` in a new process, with leaves that have not begun: those that ran. What ran
  // below a node of a plugin begins with it.
  std::vector<CutLeaf> cut_leaves() const;
  // Asks one of them, with the bytes that it kept. `cut` says what it is told, but `held`.
  void ask_after_cut(CutLeaf& leaf, std::string_view bytes, const lockstep_cut& cut);
  // Then the run goes on, with what these do. One that begins again, or has a result, does so in
  // its next tick, and until then its progress is 0. One that was held stays held. Nothing is
  // reported again.
  void go_on_after_cut(std::span<CutLeaf> cut);
  // The same where all of them start again. Returns these.
  std::vector<CutLeaf> go_on_after_cut();
  // Between two ticks: brings the state of the run to the one form that stands for all from which
  // the tree goes on in the same way, so that two of these can be compared as bytes. Time and the
  // number of the tick begin at 0 again, and nothing counts as ticked. What the leaves keep in
  // themselves, and what is reported of a run, stay as they are.
  void fold();

  // In a run that is kept: the last tick of which a checkpoint is on the disk, by the number of
  // RunState. Before each tick; until then, actions with commit="true" wait for nothing.
  void set_durable(std::uint32_t tick) { durable_ = tick; }
  // The last tick in which one of these has succeeded; 0: there was none.
  std::uint32_t last_commit() const { return last_commit_; }

 private:
  std::span<const GivenAnswer> answers_of(std::uint32_t tick) const {
    return answers_.empty() || answers_.back().number != tick ? std::span<const GivenAnswer>()
                                                              : std::span(answers_);
  }
  bool has_to_commit(std::uint32_t place) const;
  void make_room_for_progress();
  void begin_tick();
  Status tick_root_beside();
  void begin_calls();
  Status end_calls(Status result);
  void fold_entries();
  void forget_below_ended();

  std::vector<GivenAnswer> answers_;  // of one tick
  std::vector<char> leaf_room_;       // where a leaf writes what it keeps
  bool is_plain_;                     // a tick is that of the root, and nothing else
};

}  // namespace lockstep::host
