// The control nodes of the plugin nav.
#include <catch2/catch.hpp>

#include "lockstep/leaf.h"
#include "support/plugin_nodes.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

const KnownPlugin kNav(lockstep_plugin_entry);

// clang-format off
constexpr TickRow kRecoveryNode[] = {
  {"returns the success of its first child, and leaves the second alone",
   "RecoveryNode(a b)", "a=S b=S", "S[a]"},
  {"runs as long as its first child does",
   "RecoveryNode(a b)", "a=RRS b=S", "R[a] R[a] S[a]"},
  {"ticks the second child in the tick in which the first one fails",
   "RecoveryNode(a b)", "a=F b=R", "R[a b] R[b]"},
  {"tries the first child again in the tick after the second one succeeded",
   "RecoveryNode(a b)", "a=FS b=S", "R[a b] S[a]"},
  {"fails when the second child fails",
   "RecoveryNode(a b)", "a=F b=RF", "R[a b] F[b]"},
  {"fails when the first child fails once more than number_of_retries, by default 1",
   "RecoveryNode(a b)", "a=F b=S", "R[a b] F[a]"},
  {"with number_of_retries 2",
   "RecoveryNode[number_of_retries=2](a b)", "a=F b=S", "R[a b] R[a b] F[a]"},
  {"with number_of_retries 0 never ticks the second child",
   "RecoveryNode[number_of_retries=0](a b)", "a=F b=S", "F[a]"},
  {"counts the retries of each activation",
   "RecoveryNode(a b)", "a=FSFS b=S", "R[a b] S[a] R[a b] S[a]"},
  {"halts the child that runs",
   "Sequence(c? RecoveryNode(a b))", "c=SSF a=F b=R", "R[c a b] R[c b] F[c] halt[b]"},
  {"begins with its first child after a halt",
   "Sequence(c? RecoveryNode(a b))", "c=SFS a=FR b=R", "R[c a b] F[c] halt[b] R[c a]"},
  {"is skipped when its first child is, and fails when the second one is",
   "RecoveryNode(a b)", "a=KF b=K", "K[a] F[a b]"},
  {"has the progress of its first child",
   "RecoveryNode(a b)", "a=R.3F b=R.9", "R[a]=.3 R[a b]=0"},
};

constexpr TickRow kPipelineSequence[] = {
  {"succeeds when all children succeed",
   "PipelineSequence(a b)", "a=S b=S", "S[a b]"},
  {"stops at a child that runs, when none behind it was reached yet",
   "PipelineSequence(a b)", "a=RS b=S", "R[a] S[a b]"},
  {"ticks from the first child in every tick, on to where it was",
   "PipelineSequence(a b c)", "a=SSR b=SRR c=RRRS", "R[a b c] R[a b c] R[a b c] S[a b c] halt[a b]"},
  {"does not go beyond the child that it has reached, when an earlier one runs",
   "PipelineSequence(a b c)", "a=SRS b=RRS c=R", "R[a b] R[a b] R[a b c]"},
  {"goes on behind the furthest child when that succeeds, though an earlier one runs",
   "PipelineSequence(a b c)", "a=SR b=RS c=R", "R[a b] R[a b c]"},
  {"succeeds with its last child, and halts an earlier one that runs",
   "PipelineSequence(a b)", "a=SR b=RS", "R[a b] S[a b] halt[a]"},
  {"fails when any child fails, and halts those that run",
   "PipelineSequence(a b c)", "a=SSF b=R c=R", "R[a b] R[a b] F[a] halt[b]"},
  {"forgets how far it was when it completes",
   "PipelineSequence(a b)", "a=SFR b=RR", "R[a b] F[a] halt[b] R[a]"},
  {"goes on behind a child that is skipped, and is skipped when all are",
   "PipelineSequence(a b)", "a=K b=RSK", "R[a b] S[a b] K[a b]"},
  {"has the progress of the furthest child, and of those before it",
   "PipelineSequence(a b)", "a=SR.1 b=R.5", "R[a b]=.75 R[a b]=.75"},
};

constexpr TickRow kRoundRobin[] = {
  {"goes on behind a child that is skipped, and is skipped when all are",
   "RoundRobin(a b)", "a=KKF b=RSK", "R[a b] S[b] F[] K[a b] F[a b]"},
  {"returns the success of its first child",
   "RoundRobin(a b)", "a=S b=S", "S[a]"},
  {"goes on with the next child in its next activation",
   "RoundRobin(a b)", "a=S b=S", "S[a] S[b]"},
  {"tries the next child at once when one fails",
   "RoundRobin(a b)", "a=F b=S", "S[a b]"},
  {"keeps to a child that runs",
   "RoundRobin(a b)", "a=RRS b=R", "R[a] R[a] S[a] R[b]"},
  {"fails when its last child has failed, and begins with the first one again",
   "RoundRobin(a b)", "a=FS b=F", "F[a b] S[a]"},
  {"fails when its last child has succeeded before, and begins with the first one again",
   "RoundRobin(a b)", "a=S b=S", "S[a] S[b] F[] S[a]"},
  {"with wrap_around goes on with the first child after the last",
   "RoundRobin[wrap_around=true](a b)", "a=S b=S", "S[a] S[b] S[a]"},
  {"with wrap_around fails when all children have failed",
   "RoundRobin[wrap_around=true](a b c)", "a=SFS b=F c=F", "S[a] F[b c a] S[a]"},
  {"begins with the first child after a halt",
   "Sequence(c? RoundRobin(a b))", "c=SSFS a=SR b=R", "S[c a] R[c b] F[c] halt[b] R[c a]"},
};

constexpr TickRow kRateController[] = {
  {"ticks its child in its first tick",
   "RateController[hz=5](a)", "a=S", "S[a]"},
  {"runs until the period is over, also in its next activation",
   "RateController[hz=5](a)", "a=S", "S[a] R[] S[a] R[] S[a]"},
  {"ticks a child that runs in every tick",
   "RateController[hz=1](a)", "a=RRS", "R[a] R[a] S[a] R[]"},
  {"returns the failure of its child, which does not begin another period",
   "RateController[hz=2](a)", "a=FS", "F[a] R[] R[] R[] R[] S[a]"},
  {"begins a period when its child succeeds",
   "RateController[hz=5](a)", "a=RRSR", "R[a] R[a] S[a] R[] R[a]"},
  {"ticks its child at once after a halt",
   "Sequence(c? RateController[hz=1](a))", "c=SSFS a=SS", "S[c a] R[c] F[c] S[c a]"},
  {"ticks its child at once when it was not ticked for a while",
   "Fallback(c? RateController[hz=1](a))", "c=FSFF a=SS", "S[c a] S[c] S[c a] R[c]"},
  {"lets a PipelineSequence plan at its rate",
   "PipelineSequence(RateController[hz=5](a) b)", "a=S b=R", "R[a b] R[b] R[a b] R[b]"},
  {"that is no rate is a fault",
   "RateController[hz=0](a)", "a=S", "X[]=RateController"},
};
// clang-format on

}  // namespace

TEST_CASE("RecoveryNode") {
  check_rows(kRecoveryNode);
}
TEST_CASE("PipelineSequence") {
  check_rows(kPipelineSequence);
}
TEST_CASE("RoundRobin") {
  check_rows(kRoundRobin);
}
TEST_CASE("RateController") {
  check_rows(kRateController);
}

}  // namespace lockstep::host::test
