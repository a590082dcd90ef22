// What verify finds out about small random trees is what the reference interpreter does with all
// scripts of their leaves: the same results, and each first in the same tick.
#include <array>
#include <catch2/catch.hpp>
#include <optional>

#include "property/comparison.h"
#include "property/reference.h"
#include "support/trials.h"
#include "verify/search.h"

namespace lockstep::host::test {
namespace {

constexpr int kVerifyTicks = 3;
constexpr std::size_t kMostLeaves = 2;
const std::uint64_t kVerifySeeds = trials(3000);

using Results =
    std::array<std::optional<std::uint32_t>, kStatuses.size()>;  // the first tick of each

std::vector<Plan*> leaves_of(Plan& plan) {
  std::vector<Plan*> found;
  if (plan.kind == "action" || plan.kind == "condition" || plan.kind == "bare") {
    found.push_back(&plan);
  }
  for (Plan& child : plan.children) {
    for (Plan* leaf : leaves_of(child)) found.push_back(leaf);
  }
  return found;
}

// All words of this length over the letters of a leaf.
std::vector<std::string> scripts_of(const Plan& leaf, int length) {
  std::vector<std::string> words{""};
  for (int i = 0; i < length; ++i) {
    std::vector<std::string> longer;
    for (const std::string& word : words) {
      for (const char letter : std::string_view(leaf.kind == "condition" ? "SF" : "RSF")) {
        longer.push_back(word + letter);
      }
    }
    words = std::move(longer);
  }
  return words;
}

void note(Results& results, Status status, int tick) {
  auto& first = results[index_of(status)];
  const auto number = static_cast<std::uint32_t>(tick + 1);
  if (!first || number < *first) first = number;
}

// Nothing: some run has a fault, as of an entry without a value.
std::optional<Results> by_reference(const Trial& trial) {
  Trial each = trial;
  const auto leaves = leaves_of(each.plan);
  std::vector<std::vector<std::string>> scripts;
  for (const Plan* leaf : leaves) scripts.push_back(scripts_of(*leaf, kVerifyTicks));
  std::vector<std::size_t> at(leaves.size());
  Results results;
  while (true) {
    for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i]->script = scripts[i][at[i]];
    Reference reference(each.plan);
    for (int tick = 0; tick < kVerifyTicks; ++tick) {
      const Status status = reference.tick(tick * from_seconds(trial.period));
      if (reference.fault()) return std::nullopt;
      if (status == Status::Running) continue;
      note(results, status, tick);
      break;
    }
    std::size_t next = 0;
    while (next < at.size() && ++at[next] == scripts[next].size()) at[next++] = 0;
    if (next == at.size()) return results;
  }
}

std::optional<Results> by_search(const Tree& tree, double period) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const auto file = read_leaf_file(
      "t.leaves.xml", "<leaves lockstep=\"1\"><leaf path=\"*\" progress=\"none\"/></leaves>",
      diagnostics);
  const LeafModels models = make_models(tree, file.get(), diagnostics, problems);
  if (!problems.empty()) return std::nullopt;
  const SearchResult found =
      search(tree, models, {}, 1 / period, {.depth = std::uint32_t{kVerifyTicks}});
  if (!found.faults.empty()) return std::nullopt;
  CHECK_FALSE(found.broken);
  Results results;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (found.results[i]) results[i] = found.results[i]->ticks;
  }
  return results;
}

}  // namespace

TEST_CASE("verify finds the results that the reference interpreter has with all scripts",
          "[trials]") {
  std::uint64_t compared = 0;
  for (std::uint64_t seed = 0; seed < kVerifySeeds; ++seed) {
    for (Trial trial : {random_trial(seed), random_group_trial(seed)}) {
      const std::size_t leaves = leaves_of(trial.plan).size();
      if (leaves == 0 || leaves > kMostLeaves || !trial.writes.empty()) continue;
      for (Plan* leaf : leaves_of(trial.plan)) leaf->script = "R";
      const auto tree = tree_of(trial).tree;
      if (!tree) continue;
      const auto expected = by_reference(trial);
      const auto found = by_search(*tree, trial.period);
      if (!expected || !found) continue;
      ++compared;
      INFO("seed " << seed << ": " << tree_text(trial.plan));
      CHECK(*found == *expected);
    }
  }
  CHECK(compared > kVerifySeeds / 120);  // or the generator makes no small trees any more
}

}  // namespace lockstep::host::test
