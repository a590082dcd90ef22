// The control nodes of trees for BehaviorTree.CPP.
#include <catch2/catch.hpp>

#include "dialect/btcpp/rules.h"
#include "nodes/btcpp_control_laws.h"
#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kGroups[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"a barrier holds its members wherever they are",
   "ParallelAll(Sequence(a SyncProgress[barrier=g](b)) SyncProgress[barrier=g](c)) barrier[name=g barriers=.5]",
   "a=S b+.25 c+.5", "R[a b c] R[b] pause[c] R[b c] resume[c] S[b]"},
  {"a pool lets one member tick at a time",
   "ParallelAll(UseResources[pool=p resources=A](a) UseResources[pool=p resources=A keep=true](b)) resources[name=p]",
   "a=RS b=RS", "R[a] R[b] pause[a] R[b] S[a] resume[a]"},
  {"WaitUntil: begins after another one, in the next tick",
   "ParallelAll(a Sequence(WaitUntil[code=status(a)==SUCCESS] b))", "a=RS b=S", "R[a] R[a] S[b]"},
};
// clang-format on

}  // namespace

// A node asks for another tick of the tree in the period in which the group ends or begins.
TEST_CASE("BehaviorTree.CPP: a group runs while the node around its members does, in each period") {
  struct Row {
    std::string_view tree, leaves;
    Status status;  // of the group, after the first period
  };
  const Row rows[] = {
      {"SequenceWithMemory(AlwaysSuccess Sequence(UseResources[pool=p resources=A](a))) "
       "resources[name=p]",
       "a=S", Status::Idle},
      {"AsyncSequence(AlwaysSuccess UseResources[pool=p resources=A](a)) resources[name=p]", "a=S",
       Status::Idle},
      {"AsyncSequence(Sequence(UseResources[pool=p resources=A](a)) AlwaysSuccess b) "
       "resources[name=p]",
       "a=S b=R", Status::Idle},
      {"AsyncSequence(AlwaysSuccess Sequence(UseResources[pool=p resources=A](a) b)) "
       "resources[name=p]",
       "a=S b=R", Status::Running},
      {"AsyncSequence(AlwaysSuccess Parallel(SyncProgress[barrier=g](a) "
       "SyncProgress[barrier=g](b)))"
       " barrier[name=g barriers=.5]",
       "a=S b=R", Status::Running},
      {"AsyncSequence(AlwaysSuccess Fallback(Parallel(SyncProgress[barrier=g](a) "
       "SyncProgress[barrier=g](AlwaysFailure)) AlwaysSuccess) b) barrier[name=g barriers=.5]",
       "a=S b=R", Status::Idle}};
  for (const Row& row : rows) {
    INFO(row.tree);
    ScriptedRun run(row.tree, row.leaves, FaultPolicy::Stop, btcpp::kRules);
    static_cast<void>(run.tick(Nanoseconds(0)));
    CHECK(run.ticker().status(run.tree().groups.front().node) == row.status);
  }
}

TEST_CASE("BehaviorTree.CPP: barriers and pools beside the tree, and WaitUntil") {
  check_rows(kGroups, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: sequences and fallbacks") {
  check_rows(kSequences, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: parallels") {
  check_rows(kParallels, FaultPolicy::Stop, btcpp::kRules);
}

TEST_CASE("BehaviorTree.CPP: nodes that choose a child") {
  check_rows(kBranches, FaultPolicy::Stop, btcpp::kRules);
}

}  // namespace lockstep::host::test
