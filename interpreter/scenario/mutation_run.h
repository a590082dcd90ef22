// The tests of a tree tested: which small changes of it does no scenario notice?
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenario/mutations.h"
#include "scenario/test_run.h"

namespace lockstep::host {

struct MutatedTree {
  std::string file;
  std::size_t noticed = 0;
  std::size_t unusable = 0;  // changes with which it does not load
  std::vector<Mutation> survivors = {};

  std::size_t all() const { return noticed + survivors.size(); }
};

// Plays the scenarios that are chosen of each tree for each change of its main file, until one of
// them is not as expected. All of them must be good without a change.
std::vector<MutatedTree> run_mutations(
    std::span<const ScenarioFile* const> files,
    const std::function<bool(const ScenarioFile&, const Scenario&)>& is_chosen,
    const TestOptions& options);

std::string to_text(std::span<const MutatedTree> trees);
double percent(std::span<const MutatedTree> trees);

}  // namespace lockstep::host
