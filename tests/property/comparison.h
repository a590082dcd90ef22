// Runs a trial in the engine and in the reference interpreter, tick by tick.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "property/coverage.h"
#include "property/random_tree.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {

// Of a document that the checks refuse: nothing, and why.
struct TrialTree {
  std::optional<Tree> tree;
  std::string refused;
};
TrialTree tree_of(const Trial& trial);

// What the trial writes before a tick.
void write_entries(ScriptedRun& run, const Trial& trial, int tick);

// The first difference; "" when they agree, and when the trial's document is refused.
std::string difference(const Trial& trial, Coverage* coverage = nullptr,
                       GroupCoverage* groups = nullptr);

// The smallest trial that still differs, with all that is needed to look at it.
std::string report(std::uint64_t seed, const Trial& failing);

}  // namespace lockstep::host::test
