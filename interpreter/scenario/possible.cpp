#include "scenario/possible.h"

#include "engine/synchronized.h"
#include "leaves/models.h"
#include "run/live_moments.h"
#include "verify/chance_runs.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostStates = 50'000;
// Not a time, so that a busy machine sees the same.
constexpr std::uint64_t kMostTransitions = 200'000;

}  // namespace

std::optional<NodeCoverage> possible_coverage(const Tree& tree, const LeafFile* file, double rate) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems = not_verifiable(tree);
  const LeafModels models = make_models(tree, file, diagnostics, problems);
  if (!problems.empty() || diagnostics.has_errors()) return std::nullopt;
  const SearchResult found = search(
      tree, models, {}, rate,
      {.states = kMostStates, .transitions = kMostTransitions, .symmetry = false, .cycles = false});
  if (!found.is_complete()) return std::nullopt;
  if (find_contradiction(tree, models, {}, rate, found, usual_chance(found))) return std::nullopt;
  // Each tick of the search once more, now with what was before it.
  NodeCoverage coverage(tree);
  Stepper stepper(tree, models, {}, rate, found.symmetry, found.rising_answers,
                  found.few_root_ticks, found.few_ticks);
  LiveMoments moments(tree, {.within = true});
  for (StateId state = 0; state < found.store.size(); ++state) {
    stepper.load(found.store[state], state == 0);
    const std::vector<Activity> before = stepper.before().run.activity;
    do {
      stepper.tick();
      coverage.add(before, moments.after_tick(stepper.ticker(), 0, {}));
    } while (stepper.next());
  }
  return coverage;
}

AspectSet usual_aspects(const Tree& tree, NodeIndex node) {
  AspectSet aspects;
  // The author of a tree cannot decide what a built-in action does.
  const NodeType& type = *tree.labels[node].type;
  if (type.category == NodeCategory::Action && type.leaf == nullptr) {
    aspects.add(Aspect::Ticked);
    return aspects;
  }
  for (const Aspect it : {Aspect::Ticked, Aspect::Success, Aspect::Failure}) aspects.add(it);
  const NodeIndex parent = tree.labels[node].parent;
  const bool is_member_child = barrier_member(tree, parent) != nullptr;
  const bool is_synchronized = node != 0 && compares_progress(synchronization(tree.nodes[parent]));
  if (is_synchronized || is_member_child) aspects.add(Aspect::Held);
  return aspects;
}

}  // namespace lockstep::host
