// Runs of a search once more: what each tick of one did, and the script of its leaves.
#pragma once

#include <functional>
#include <span>

#include "leaves/leaf_script.h"
#include "verify/search.h"

namespace lockstep::host {

// A tick of a run: the state before it, with each child where it is in that run, and the answers of
// its leaves.
struct TracedTick {
  StateBytes before;
  bool is_first = false;
  std::vector<LeafAnswer> answers = {};
};
using TracedRun = std::vector<TracedTick>;

// A step of a search, before and after which leaves in equal states change places.
struct GuidedStep {
  StateId from = kNoState;
  std::vector<LeafAnswer> answers = {};
  Swaps swaps = {};
  Swap after = {};
};

// A run along steps of a search, as far as it has come. Where equal children have changed places in
// the search, they stay in theirs in the run.
struct TracedPath {
  TracedRun run;
  StateBytes now, searched;      // the state that it has come to, and the one of the search
  std::vector<NodeIndex> nodes;  // of each place in the search: the node of the run that is there
};

// Adds to scripts what the leaves did in the last tick, and from now on what they do within one.
class ScriptWriter {
 public:
  // All must outlive this.
  ScriptWriter(const Tree& tree, const LeafModels& models, Stepper& stepper, LeafScripts& scripts);
  ~ScriptWriter();
  ScriptWriter(const ScriptWriter&) = delete;
  ScriptWriter& operator=(const ScriptWriter&) = delete;

  void add_tick();

 private:
  void add(std::uint32_t leaf);

  const Tree& tree_;
  const LeafModels& models_;
  Stepper& stepper_;
  LeafScripts& scripts_;
};

class Tracer {
 public:
  // All must outlive this.
  Tracer(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
         double rate, const SearchResult& found);

  // The combinations of answers that take states over these edges, which are of cycles.
  std::vector<GuidedStep> steps_of(std::span<const CycleStep> edges);

  // `nodes`: of each place, the node that begins there; empty: its own.
  TracedPath begin(std::vector<NodeIndex> nodes = {});
  void go(TracedPath& traced, std::span<const GuidedStep> steps);
  void go(TracedPath& traced, const GuidedStep& step);
  void go(TracedPath& traced, const Occurrence& it) {
    go(traced, GuidedStep{.from = it.from, .answers = it.answers});
  }
  // From the first of these states of the search on to each other one, by the first tick that does.
  void go(TracedPath& traced, std::span<const StateId> path);
  // Rounds of a cycle until everything is where it was.
  void go_round(TracedPath& traced, std::span<const GuidedStep> cycle);

  // After each tick; its state is not folded yet.
  using After = std::function<void(Stepper&, Status status, std::size_t tick)>;
  void play(const TracedRun& run, const After& after);
  // All ticks from a state of the search, as long as `gives_up`, which is asked within a tick too,
  // is false, and `call` true. False: some are missing.
  bool for_each_tick(StateId from, const std::function<bool()>& gives_up,
                     const std::function<bool(const Stepper&)>& call);
  // One of the ticks of a run; then `ticker` is as it was behind it.
  Status tick(const TracedTick& tick);
  const Ticker& ticker() const { return stepper_.ticker(); }

  // The scripts say what each leaf does in this run.
  LeafScripts scripts(const TracedRun& run);

 private:
  struct Outcome;

  StateBytes state_of(StateId state);
  GuidedStep step_of(const CycleStep& edge);
  GuidedStep first_step(std::span<const std::byte> state, StateId from, StateId to);
  template <class IsWanted>
  GuidedStep find_step(std::span<const std::byte> state, StateId from, const IsWanted& is_wanted);
  Status tick(std::span<const std::byte> state, const GuidedStep& step);
  Outcome outcome(Status status);
  void swap(std::vector<NodeIndex>& nodes, const Swap& swap) const;
  std::vector<LeafAnswer> moved(std::vector<LeafAnswer> answers,
                                std::span<const NodeIndex> nodes) const;
  void add_cut(std::uint64_t tick, LeafScripts& scripts);
  [[noreturn]] void fail(const char* what) const;

  const Tree& tree_;
  const LeafModels& models_;
  const SearchResult& found_;
  Stepper stepper_;
  Labeller labeller_;
};

}  // namespace lockstep::host
