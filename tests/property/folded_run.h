// A run between two ticks, brought to what a state of verify has of it.
#pragma once

#include "support/scripted_run.h"
#include "verify/read_holds.h"

namespace lockstep::host::test {

// `tree` says what is read: that of the run, or one with other kinds. A leaf stays held, so that
// its calls can be compared.
inline void fold(ScriptedRun& run, const Tree& tree) {
  run.ticker().fold();
  SavedRun saved;
  run.ticker().save(saved);
  const ReadHolds holds(tree, std::vector<bool>(tree.leaves.size(), true));
  holds.forget_others(run.ticker(), saved.run.activity);
  run.ticker().restore(saved);
}
inline void fold(ScriptedRun& run) {
  fold(run, run.tree());
}

}  // namespace lockstep::host::test
