#include "verify/trace.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace lockstep::host {

// All of a tick that a search tells apart.
struct Tracer::Outcome {
  Status status;
  std::optional<NodeIndex> fault;
  bool is_broken;
  std::vector<std::size_t> violated;
  Label label;
  StateBytes state = {};     // empty: the run has ended
  StateBytes searched = {};  // the same with equal children in one order

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Tracer::Tracer(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
               double rate, const SearchResult& found)
    : tree_(tree),
      models_(models),
      found_(found),
      stepper_(tree, models, properties, rate, found.symmetry, found.rising_answers,
               found.few_root_ticks, found.few_ticks, found.joins),
      labeller_(tree, models, properties.size(), found.symmetry) {}

// One that the store has forgotten is made again.
StateBytes Tracer::state_of(StateId state) {
  if (!found_.store.keeps_hashes()) {
    const auto bytes = found_.store[state];
    return {bytes.begin(), bytes.end()};
  }
  StateBytes here = stepper_.first_state();
  const std::vector<StateId> path = found_.path_to(state);
  for (std::size_t i = 1; i < path.size(); ++i) {
    StateBytes next;  // a tick is folded once
    find_step(here, path[i - 1], [&] {
      next = stepper_.fold();
      return found_.store.is(path[i], next);
    });
    here = std::move(next);
  }
  return here;
}

// The tick of the step is the last one.
template <class IsWanted>
GuidedStep Tracer::find_step(std::span<const std::byte> state, StateId from,
                             const IsWanted& is_wanted) {
  stepper_.load(state, from == 0);
  do {
    const Status status = stepper_.tick();
    const bool goes_on = status == Status::Running && !stepper_.ticker().faulted();
    if (goes_on && !stepper_.is_known() && is_wanted()) return {from, stepper_.answers().asked()};
  } while (stepper_.next());
  fail("an edge of a search is not there any more");
}

GuidedStep Tracer::first_step(std::span<const std::byte> state, StateId from, StateId to) {
  return find_step(state, from, [&] { return found_.store.is(to, stepper_.fold()); });
}

GuidedStep Tracer::step_of(const CycleStep& wanted) {
  Label label;
  found_.graph_of_cycles().read(wanted.edge, label);
  GuidedStep step = find_step(state_of(wanted.from), wanted.from, [&] {
    labeller_.of(stepper_);
    return found_.store.is(wanted.edge.to, stepper_.fold()) &&
           labeller_.with_moves(stepper_) == label;
  });
  step.swaps = wanted.swaps;
  step.after = wanted.after;
  return step;
}

std::vector<GuidedStep> Tracer::steps_of(std::span<const CycleStep> edges) {
  std::vector<GuidedStep> steps;
  for (const CycleStep& it : edges) steps.push_back(step_of(it));
  return steps;
}

TracedPath Tracer::begin(std::vector<NodeIndex> nodes) {
  if (nodes.empty()) {
    nodes.resize(tree_.nodes.size());
    std::iota(nodes.begin(), nodes.end(), NodeIndex{0});
  }
  const StateBytes first = stepper_.first_state();
  return {{}, first, first, std::move(nodes)};
}

Status Tracer::tick(std::span<const std::byte> state, const GuidedStep& step) {
  stepper_.load(state, step.from == 0);
  stepper_.give(step.answers);
  return stepper_.tick();
}

Status Tracer::tick(const TracedTick& tick) {
  stepper_.load(tick.before, tick.is_first);
  stepper_.give(tick.answers);
  return stepper_.tick();
}

Tracer::Outcome Tracer::outcome(Status status) {
  const Fault* fault = stepper_.ticker().fault();
  Outcome outcome{status,
                  fault != nullptr ? std::optional(fault->node) : std::nullopt,
                  !stepper_.leaves().broken().empty(),
                  {stepper_.violated().begin(), stepper_.violated().end()},
                  labeller_.of(stepper_)};
  if (status == Status::Running && fault == nullptr) {
    outcome.searched = stepper_.fold();
    outcome.state = stepper_.in_place();
  }
  return outcome;
}

void Tracer::go(TracedPath& traced, std::span<const GuidedStep> steps) {
  for (const GuidedStep& step : steps) go(traced, step);
}

void Tracer::go(TracedPath& traced, std::span<const StateId> path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    go(traced, first_step(traced.searched, path[i - 1], path[i]));
  }
}

// The run does in its places what the search does in others.
void Tracer::go(TracedPath& traced, const GuidedStep& step) {
  for (const Swap& it : step.swaps) swap(traced.nodes, it);
  Outcome wanted = outcome(tick(traced.searched, step));
  TracedTick next{traced.now, step.from == 0, stepper_.answers().asked()};
  traced.searched = wanted.searched;
  if (!found_.symmetry.empty()) {
    const std::vector<NodeIndex> nodes = traced.nodes;
    if (!wanted.state.empty()) {
      const auto origins = stepper_.origins();
      for (std::size_t i = 0; i < origins.size(); ++i) traced.nodes[i] = nodes[origins[i]];
      wanted.state = stepper_.moved(wanted.state, nodes);
    }
    wanted.label = labeller_.moved(wanted.label, nodes);
    next.answers = moved(std::move(next.answers), nodes);
    if (outcome(tick(next)) != wanted) fail("children that change places are not equal");
  }
  swap(traced.nodes, step.after);
  traced.now = wanted.state;
  traced.run.push_back(std::move(next));
}

void Tracer::swap(std::vector<NodeIndex>& nodes, const Swap& swap) const {
  const auto classes = found_.symmetry.classes();  // the inner ones first
  for (const LabelShape::Exchange& it : found_.graph.shape.exchanges(swap)) {
    const EqualChildren& all = classes[classes.size() - 1 - it.children];
    const auto one = nodes.begin() + all.places[it.one].node;
    std::swap_ranges(one, one + all.nodes, nodes.begin() + all.places[it.other].node);
  }
}

// The answers of the leaves that have the places of these. Those of facts are the same.
std::vector<LeafAnswer> Tracer::moved(std::vector<LeafAnswer> answers,
                                      std::span<const NodeIndex> nodes) const {
  for (LeafAnswer& it : answers) {
    if (it.asker < tree_.leaves.size()) {
      it.asker = tree_.nodes[nodes[tree_.leaves[it.asker].node]].params;
    }
  }
  return answers;
}

void Tracer::go_round(TracedPath& traced, std::span<const GuidedStep> cycle) {
  constexpr int kMostRounds = 100'000;  // changes of places come back to the first far earlier
  const StateBytes start = traced.now;
  for (int round = 0; round < kMostRounds; ++round) {
    go(traced, cycle);
    if (traced.now == start) return;
  }
  fail("a cycle does not come back to where it began");
}

// A store that keeps hashes may have taken two states for one.
void Tracer::fail(const char* what) const {
  if (!found_.store.keeps_hashes()) throw std::logic_error(what);
  throw std::runtime_error(
      "two states have the same hash, so what was found cannot be shown: verify without --compact");
}

void Tracer::play(const TracedRun& run, const After& after) {
  for (std::size_t i = 0; i < run.size(); ++i) after(stepper_, tick(run[i]), i);
}

bool Tracer::for_each_tick(StateId from, const std::function<bool()>& gives_up,
                           const std::function<bool(const Stepper&)>& call) {
  stepper_.load(state_of(from), from == 0);
  stepper_.set_gives_up(gives_up);
  bool goes_on = true;
  do {
    stepper_.tick();
    goes_on = stepper_.is_done() && call(stepper_) && !gives_up();
  } while (goes_on && stepper_.next());
  stepper_.set_gives_up(nullptr);
  return goes_on;
}

LeafScripts Tracer::scripts(const TracedRun& run) {
  LeafScripts scripts;
  scripts.ticks = run.size();
  ScriptWriter writer(tree_, models_, stepper_, scripts);
  play(run, [&](Stepper& stepper, Status, std::size_t tick) {
    if (stepper.was_cut()) add_cut(tick, scripts);
    writer.add_tick();
  });
  return scripts;
}

void Tracer::add_cut(std::uint64_t tick, LeafScripts& scripts) {
  ScriptCut& cut = scripts.cuts.emplace_back(ScriptCut{.tick = tick});
  for (const CutLeaf& it : stepper_.cut_leaves()) {
    if (it.does == AfterCut::StartsAgain) continue;
    cut.leaves[tree_.path(tree_.leaves[it.place].node)] = it.does;
  }
}

// A leaf has a word for each tick of it, and several in a period where nodes ask for them.
ScriptWriter::ScriptWriter(const Tree& tree, const LeafModels& models, Stepper& stepper,
                           LeafScripts& scripts)
    : tree_(tree), models_(models), stepper_(stepper), scripts_(scripts) {
  stepper.set_before_tick_again([this](ModelLeaves& leaves) {
    add_tick();
    leaves.clear_marks();
  });
  stepper.set_before_leaf_again([this](std::uint32_t leaf) { add(leaf); });
}

ScriptWriter::~ScriptWriter() {
  stepper_.set_before_tick_again(nullptr);
  stepper_.set_before_leaf_again(nullptr);
}

void ScriptWriter::add_tick() {
  for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) add(leaf);
}

void ScriptWriter::add(std::uint32_t leaf) {
  const LeafMark& mark = std::as_const(stepper_).leaves().marks()[leaf];
  // What it writes in its start may be a fault: then it has no tick.
  const bool has_written =
      std::ranges::any_of(mark.written, [](auto it) { return it != kNoWrite; });
  const bool has_word = mark.ticked || has_written;
  if ((!has_word && !mark.drifted) || stepper_.leaves().is_outside(leaf)) return;
  auto& words = scripts_.leaves[tree_.path(tree_.leaves[leaf].node)];
  if (mark.drifted) {
    words.push_back({.kind = LeafWord::Kind::Held, .progress = mark.held_progress});
  }
  if (!has_word) return;
  LeafWord word{.kind = mark.faulted ? LeafWord::Kind::Fault : LeafWord::Kind::Tick,
                .status = mark.ticked ? mark.result : Status::Running,
                .progress = mark.result == Status::Running ? mark.progress : 0};
  const auto& outputs = models_.leaves[leaf].outputs;
  for (std::size_t i = 0; i < mark.written.size(); ++i) {
    if (mark.written[i] == kNoWrite) continue;
    const auto& output = outputs[i % outputs.size()];
    word.written.emplace_back(tree_.leaves[leaf].type->parameters[output.port].name,
                              to_text(output.values[mark.written[i]]));
  }
  words.push_back(std::move(word));
}

}  // namespace lockstep::host
