#include "scenario/verified_scenario.h"

#include <fmt/format.h>

#include "base/core/wording.h"
#include "verify/chance_runs.h"
#include "verify/verdict.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostMemory = std::size_t{1} << 30u;  // bytes

// The place of the property that it is about, if it is one of the scenario.
Place place_of(const Finding& finding, const BoundScenario& bound) {
  for (const PreparedProperty& it : bound.properties) {
    if (finding.name == "property/" + it.property.name()) return it.of->place;
  }
  return bound.scenario->place;
}

// No result may come but the expected ones.
void add_results(const BoundScenario& bound, const SearchResult& found,
                 std::vector<Surprise>& surprises) {
  for (const Expectation& it : bound.scenario->expectations) {
    if (it.kind != Expectation::Kind::Ending || it.results.empty()) continue;
    for (const Status status : {Status::Success, Status::Failure, Status::Skipped}) {
      const auto& first = found.results[index_of(status)];
      if (!first || it.expects(to_string(status))) continue;
      surprises.push_back(
          {it.result_place,
           fmt::format("expected {}, {} may come, after {}", joined(it.results, " or "),
                       to_string(status), counted(first->ticks, "tick")),
           {}});
    }
  }
}

}  // namespace

std::vector<Surprise> verify_scenario(const BoundScenario& bound, const Fixture& fixture,
                                      const LeafFile* file,
                                      const std::function<int()>& stop_signal) {
  const Tree& tree = fixture.tree();
  const Place place = bound.scenario->place;
  std::vector<Property> properties = fixture.properties();
  for (const PreparedProperty& it : bound.properties) properties.push_back(it.property);
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems = not_verifiable(tree);
  const Observed observed = observed_by(tree, properties, problems);
  const LeafModels models = make_models(tree, file, diagnostics, problems, observed);
  std::vector<Surprise> surprises;
  for (const NodeProblem& it : problems) {
    surprises.push_back({place,
                         fmt::format("cannot be verified: {}", it.message),
                         {fixture.place_of(it.node) + ": " + tree.path(it.node), it.hint}});
  }
  if (!problems.empty()) return surprises;
  const SearchResult found = search(tree, models, properties, bound.rate,
                                    {.memory = kMostMemory, .stop_signal = stop_signal});
  const Verdict verdict = make_verdict(
      tree, models, properties, found,
      {.rate = bound.rate, .place = [&](NodeIndex node) { return fixture.place_of(node); }});
  for (const Finding& it : verdict.findings) {
    if (!it.accepted.empty()) continue;
    surprises.push_back(
        {place_of(it, bound), fmt::format("finding {}: {}", it.name, it.message), it.more});
    if (!it.run.empty()) surprises.back().more.push_back("lockstep verify shows a run to it");
  }
  add_results(bound, found, surprises);
  const auto wrong =
      find_contradiction(tree, models, properties, bound.rate, found, usual_chance(found));
  if (wrong) surprises.push_back({place, to_text(*wrong), {"this is a bug in lockstep"}});
  if (!found.is_complete() && surprises.empty()) {
    surprises.push_back({place,
                         fmt::format("not verified: nothing found in the first {}, and there are "
                                     "more states",
                                     counted(found.complete_depth(), "tick")),
                         {"a lower rate or a leaf model makes them fewer"}});
  }
  return surprises;
}

}  // namespace lockstep::host
