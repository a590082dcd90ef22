// Tables of laws. A row is a tree text, a script for each leaf, and what must come of it, tick by
// tick:
//   R[a b] S[a] halt[b]    a tick that returns Running (S Success, F Failure, K Skipped) and ticks
//   a, then
//                          b; a tick that returns
//                          Success, ticks a and halts b. Halts, pauses and resumes are always
//                          compared, in their order; starts are not.
//   R{start a, tick a}     a tick with everything that its leaves were told, in order.
//   R[a]=.5                the progress of the root after the tick is .5.
//   X[a]=a                 a tick that ends in a fault of leaf a (and halts what still runs).
//   goal:=2 S[]            the entry 'goal' is set to 2 before the tick; 2.0 is a double.
//   F[a]!a                 leaf a was at fault in the tick, and the run goes on; stop!a: in its
//   halt. stop                   not a tick: the owner halts the run.
#pragma once

#include <span>

#include "engine/ticker.h"
#include "support/tick_row.h"

namespace lockstep::host::test {

// Fails the Catch test for each row that does not hold, showing law, tree, expected and got.
void check_rows(std::span<const TickRow> rows, FaultPolicy policy = FaultPolicy::Stop,
                const LanguageRules& rules = kLockstepRules);

}  // namespace lockstep::host::test
