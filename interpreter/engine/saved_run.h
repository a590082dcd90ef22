// All of a run between two ticks, but what the leaves keep in themselves: what a Ticker can be
// taken back to (Ticker::save, Ticker::restore). A search saves many, so each reuses its memory.
#pragma once

#include <cstdint>
#include <vector>

#include "base/blackboard/entry.h"
#include "base/core/after_cut.h"
#include "engine/bound_parameters.h"
#include "engine/held_leaves.h"
#include "engine/named_entries.h"
#include "engine/run_state.h"
#include "trace/answer.h"

namespace lockstep::host {

// The engine's part of a leaf's state.
struct SlotState {
  bool started, failed, out_of_range, went_on;
  bool was_cut = false;  // and has not begun since: what it does then
  AfterCut does = AfterCut::StartsAgain;

  friend bool operator==(const SlotState&, const SlotState&) = default;
};

struct SavedRun {
  RunState run;
  std::vector<Entry> entries;  // of the blackboard
  NamedEntries::Made named;
  BoundParameters::State parameters;
  HeldLeaves held_leaves{0};
  std::vector<SlotState> leaves;
  std::vector<GivenAnswer> answers;  // that the next tick takes
};

// The same where it is, without a copy: valid as long as nothing changes. The flags of leaves
// follow from the rest, but which of them have failed.
struct RunParts {
  const RunState& run;
  const std::vector<Entry>& entries;
  const NamedEntries::Made& named;
  const BoundParameters::State& parameters;
  const HeldLeaves& held_leaves;
  const std::vector<GivenAnswer>& answers;
  std::vector<std::uint32_t> failed = {};  // in Tree::leaves
};
RunParts parts_of(const SavedRun& run);

}  // namespace lockstep::host
