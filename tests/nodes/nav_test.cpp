// The control nodes and conditions of the plugin nav.
#include <catch2/catch.hpp>

#include "../../plugins/nav/control_leaves.hpp"
#include "dialect/btcpp/rules.h"
#include "lockstep/leaf.h"
#include "support/plugin_nodes.h"
#include "support/scripted_run.h"
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
  {"after a skipped recovery the next activation continues the count of retries",
   "RecoveryNode(a b)", "a=F b=SKS", "R[a b] F[a]"},
  {"after a skipped recovery the next activation continues the count of retries, of 2",
   "RecoveryNode[number_of_retries=2](a b)", "a=F b=SKS", "R[a b] F[a b] R[a b] F[a]"},
  {"has the progress of its first child",
   "RecoveryNode(a b)", "a=R.3F b=R.9", "R[a]=.3 R[a b]=0"},
};

constexpr TickRow kPipelineSequence[] = {
  {"succeeds when all children succeed",
   "PipelineSequence(a b)", "a=S b=S", "S[a b]"},
  {"stops at a child that runs, when none behind it was reached yet",
   "PipelineSequence(a b)", "a=RS b=S", "R[a] S[a b]"},
  {"ticks from the first child in every tick, on to where it was",
   "PipelineSequence(a? b c)", "a=SSS b=R c=RRS", "R[a b] R[a b] R[a b]"},
  {"an action that has completed keeps its result until all end, and is not ticked",
   "PipelineSequence(a b c)", "a=S b=RS c=RRS", "R[a b] R[b c] R[c] S[c] S[a b c]"},
  {"a control node that has completed begins again",
   "PipelineSequence(Sequence(a) b)", "a=SRS b=R", "R[a b] R[a b] R[a b] R[a b]"},
  {"does not go beyond the child that it has reached, when an earlier one runs",
   "PipelineSequence(Sequence(a) Sequence(b) c)", "a=SRS b=RRS c=R", "R[a b] R[a b] R[a b c]"},
  {"goes on behind the furthest child when that succeeds, though an earlier one runs",
   "PipelineSequence(Sequence(a) b c)", "a=SR b=RS c=R", "R[a b] R[a b c]"},
  {"succeeds with its last child, and halts an earlier one that runs",
   "PipelineSequence(Sequence(a) b)", "a=SR b=RS", "R[a b] S[a b] halt[a]"},
  {"fails when any child fails, and halts those that run",
   "PipelineSequence(a? b c)", "a=SSF b=R c=R", "R[a b] R[a b] F[a] halt[b]"},
  {"forgets how far it was when it completes",
   "PipelineSequence(a? b)", "a=SFS b=RR", "R[a b] F[a] halt[b] R[a b]"},
  {"goes on behind a child that is skipped, and is skipped when all are",
   "PipelineSequence(a b)", "a=K b=RSK", "R[a b] S[a b] K[a b]"},
  {"has the progress of the furthest child, and of those before it",
   "PipelineSequence(Sequence(a) b)", "a=SR.1 b=R.5", "R[a b]=.75 R[a b]=.75"},
};

constexpr TickRow kRoundRobin[] = {
  {"goes on behind a child that is skipped, and is skipped when all are",
   "RoundRobin(a b)", "a=KKKF b=RSK", "R[a b] S[b] K[a b] K[a b] F[a b]"},
  {"returns the success of its first child",
   "RoundRobin(a b)", "a=S b=S", "S[a]"},
  {"continues with the next child in its next activation, after the last with the first",
   "RoundRobin(a b)", "a=S b=S", "S[a] S[b] S[a] S[b]"},
  {"tries the next child at once when one fails",
   "RoundRobin(a b)", "a=F b=S", "S[a b]"},
  {"keeps to a child that runs",
   "RoundRobin(a b)", "a=RRS b=R", "R[a] R[a] S[a] R[b]"},
  {"fails when all children have failed, and begins with the first one again",
   "RoundRobin(a b c)", "a=SFS b=F c=F", "S[a] F[b c a] S[a]"},
  {"begins with the first child after a halt",
   "Sequence(c? RoundRobin(a b))", "c=SSFS a=SR b=R", "S[c a] R[c b] F[c] halt[b] R[c a]"},
  {"without wrap_around fails when its last child has failed",
   "RoundRobin[wrap_around=false](a b)", "a=SS b=F", "S[a] F[b] S[a]"},
  {"without wrap_around fails when its last child has succeeded",
   "RoundRobin[wrap_around=false](a b)", "a=S b=S", "S[a] F[b] S[a] F[b]"},
  {"without wrap_around fails when its last child is skipped, unless all were",
   "RoundRobin[wrap_around=false](a b)", "a=SKS b=K", "S[a] F[b] K[a b] S[a]"},
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

constexpr TickRow kSpeedController[] = {
  {"ticks its child in its first tick, and at max_rate at max_speed",
   "SpeedController[min_rate=2 max_rate=5 max_speed=1 speed=1](a)", "a=S", "S[a] R[] S[a] R[]"},
  {"at max_rate above it",
   "SpeedController[min_rate=2 max_rate=5 max_speed=1 speed=3](a)", "a=S", "S[a] R[] S[a]"},
  {"its first period has max_rate, the next one min_rate at min_speed, and below",
   "SpeedController[min_rate=2.5 max_rate=10 min_speed=.5 max_speed=1 speed=.2](a)", "a=S", "S[a] S[a] R[] R[] R[] S[a]"},
  {"at a rate in between at a speed in between",
   "SpeedController[min_rate=1 max_rate=4 max_speed=1 speed=.5](a)", "a=S", "S[a] R[] R[] S[a] R[] R[] R[] S[a]"},
  {"backward as forward",
   "SpeedController[min_rate=1 max_rate=5 max_speed=1 speed=-1](a)", "a=S", "S[a] R[] S[a] R[] S[a]"},
  {"at max_rate from the one speed on that is least and greatest",
   "SpeedController[min_rate=1 max_rate=5 min_speed=1 max_speed=1 speed=1](a)", "a=S", "S[a] R[] S[a]"},
  {"a period has the rate of the entry 'speed' at its beginning",
   "SpeedController[min_rate=2.5 max_rate=10 max_speed=1](a)", "a=S",
   "speed:=0.0 S[a] S[a] speed:=1.0 R[] R[] R[] S[a] S[a] S[a]"},
  {"a period begins when the child is started, not when it succeeds",
   "SpeedController[min_rate=2.5 max_rate=10 max_speed=1 speed=0](a)", "a=SRRSS", "S[a] R[a] R[a] S[a] R[] S[a]"},
  {"without a speed is a fault",
   "SpeedController(a)", "a=S", "X[]=SpeedController"},
  {"ticks its child at once for another goal",
   "SpeedController[min_rate=1 max_rate=1 speed=1](a)", "a=S", "S[a] R[] goal:=2 S[a] R[] goals:=2 S[a]"},
  {"ticks a child that runs in every tick",
   "SpeedController[min_rate=1 max_rate=1 speed=1](a)", "a=RRS", "R[a] R[a] S[a] R[]"},
  {"ticks its child at once after a halt",
   "Sequence(c? SpeedController[min_rate=1 max_rate=1 speed=1](a))", "c=SSFS a=SS", "S[c a] R[c] F[c] S[c a]"},
};

constexpr TickRow kDistanceController[] = {
  {"ticks its child in its first tick, and again after the distance",
   "DistanceController(a)", "a=S", "x:=3.0 y:=0.0 S[a] x:=3.9 R[] x:=4.0 S[a] x:=4.5 R[]"},
  {"measures from where its child succeeded, as the crow flies",
   "DistanceController(a)", "a=RRS", "x:=0.0 y:=0.0 R[a] x:=5.0 R[a] S[a] x:=5.6 R[] y:=0.8 S[a]"},
  {"does not count the way there and back",
   "DistanceController[distance=.5](a)", "a=S", "x:=0.0 y:=0.0 S[a] x:=0.4 R[] x:=0.0 R[] x:=-0.4 R[] x:=-0.5 S[a]"},
  {"starts a child that has failed again",
   "DistanceController(a)", "a=FS", "x:=0.0 y:=0.0 F[a] S[a] R[]"},
  {"ticks its child at once after a halt",
   "Sequence(c? DistanceController(a))", "c=SSFS a=SS", "x:=0.0 y:=0.0 S[c a] R[c] F[c] S[c a]"},
  {"ticks its child at once when it was not ticked for a while",
   "Fallback(c? DistanceController(a))", "c=FSFF a=SS", "x:=0.0 y:=0.0 S[c a] S[c] S[c a] R[c]"},
  {"without a position is a fault",
   "DistanceController(a)", "a=S", "x:=0.0 X[]=DistanceController"},
};

constexpr TickRow kGoalUpdatedController[] = {
  {"ticks its child in its first tick, and then once for each goal",
   "GoalUpdatedController(a)", "a=S", "S[a] R[] goal:=1 S[a] R[] R[] goal:=2 S[a] R[]"},
  {"an entry that is set to the value that it has has not changed",
   "GoalUpdatedController(a)", "a=S", "goal:=1 S[a] goal:=1 R[]"},
  {"for several goals, too",
   "GoalUpdatedController(a)", "a=S", "S[a] goals:=1 S[a] R[] goal:=1 goals:=2 S[a] R[]"},
  {"for a goal of another entry",
   "GoalUpdatedController[goal={place}](a)", "a=S", "S[a] place:=1 S[a] R[]"},
  {"ticks a child that runs in every tick",
   "GoalUpdatedController(a)", "a=RRS", "R[a] R[a] S[a] R[]"},
  {"a child that runs sees another goal itself: it is not begun again",
   "GoalUpdatedController(a)", "a=RRS", "R[a] goal:=2 R{tick a} S[a] R[]"},
  {"starts a child that has failed again",
   "GoalUpdatedController(a)", "a=FS", "F[a] S[a] R[]"},
  {"ticks its child at once after a halt",
   "Sequence(c? GoalUpdatedController(a))", "c=SSFS a=SS", "S[c a] R[c] F[c] S[c a]"},
  {"ticks its child at once when it was not ticked in the tick before",
   "Fallback(c? GoalUpdatedController(a))", "c=FSFF a=SS", "S[c a] S[c] S[c a] R[c]"},
  {"lets a PipelineSequence plan for each goal",
   "PipelineSequence(GoalUpdatedController(a) b)", "a=S b=R", "R[a b] R[b] goal:=1 R[a b] R[b]"},
};

constexpr TickRow kGoalUpdated[] = {
  {"fails in its first tick, and as long as the goal stays",
   "GoalUpdated", "", "goal:=1 F[] F[] goal:=1 F[]"},
  {"succeeds once for each goal",
   "GoalUpdated", "", "F[] goal:=1 S[] F[] goal:=2 S[] goal:=3 S[] F[]"},
  {"for several goals, too, and once for both",
   "GoalUpdated", "", "F[] goals:=1 S[] F[] goal:=1 goals:=2 S[] F[]"},
  {"for a goal of another entry",
   "GoalUpdated[goal={place}]", "", "F[] place:=1 S[] F[]"},
  {"begins again when it was not ticked in the tick before",
   "Fallback(c? Sequence(GoalUpdated a))", "c=FSFF a=S", "F[c] goal:=1 S[c] F[c] goal:=2 S[c a]"},
  {"ends what is behind it for another goal",
   "Fallback(GoalUpdated a)", "a=R", "R[a] R[a] goal:=2 S[] halt[a]"},
};

constexpr TickRow kGlobalUpdatedGoal[] = {
  {"succeeds in its first tick, and then once for each goal",
   "GlobalUpdatedGoal", "", "S[] F[] goal:=1 S[] F[] goals:=1 S[] F[]"},
  {"sees a goal that came however long ago",
   "Fallback(c? Sequence(GlobalUpdatedGoal a))", "c=FSSSSSSF a=S",
   "S[c a] goal:=1 S[c] S[c] S[c] S[c] S[c] S[c] S[c a]"},
  {"does not begin again when it was not ticked for a while",
   "Fallback(c? Sequence(GlobalUpdatedGoal a))", "c=FSSSSSSF a=S",
   "S[c a] S[c] S[c] S[c] S[c] S[c] S[c] F[c]"},
};

constexpr TickRow kPathExpiringTimer[] = {
  {"succeeds when the time is over, and begins it again",
   "PathExpiringTimer[seconds=.3]", "", "F[] F[] F[] S[] F[] F[] S[]"},
  {"another path begins the time again",
   "PathExpiringTimer[seconds=.2]", "", "path:=1 F[] F[] path:=2 F[] F[] S[] path:=2 F[] path:=3 F[] F[] S[]"},
  {"counts the time in which it was not ticked",
   "Fallback(c? Sequence(PathExpiringTimer[seconds=1] a))", "c=FSSSSSSSSSF a=S",
   "F[c] S[c] S[c] S[c] S[c] S[c] S[c] S[c] S[c] S[c] S[c a]"},
  {"its first tick begins the time",
   "PathExpiringTimer[seconds=0]", "", "F[] S[] path:=1 F[] S[]"},
};

// In trees for BehaviorTree.CPP: what Nav2's own nodes do over that library (Humble to Lyrical, and
// BehaviorTree.CPP 4.9.1), found by running both on random trees.
constexpr TickRow kOfNav2[] = {
  {"RecoveryNode tries its first child again in the tick in which the recovery succeeds",
   "RecoveryNode(a b)", "a=FS b=S", "S[a b a]"},
  {"RecoveryNode fails in the tick in which the first child has failed too often",
   "RecoveryNode[number_of_retries=2](a b)", "a=F b=S", "F[a b a b a]"},
  {"RecoveryNode goes on from a recovery that takes time",
   "RecoveryNode(a b)", "a=FR b=RS", "R[a b] R[b a]"},
  {"RecoveryNode continues the count of retries after a skipped recovery",
   "RecoveryNode[number_of_retries=2](a b)", "a=F b=SKSS", "F[a b a b] F[a b a]"},
  {"RecoveryNode begins the count again after a halt",
   "ReactiveSequence(c? RecoveryNode[number_of_retries=2](a b))", "c=SSFS a=FFRFFS b=SKSS",
   "F[c a b a b] R[c a] F[c] halt[a] S[c a b a b a]"},
  {"PipelineSequence does not begin a completed action again",
   "PipelineSequence(a b)", "a=S b=RRSR", "R[a b] R[b] S[b] R[a b]"},
  {"PipelineSequence begins a completed control node again",
   "PipelineSequence(Sequence(a) b)", "a=S b=RRSR", "R[a b] R[a b] S[a b] R[a b]"},
  {"PipelineSequence asks a condition in each tick",
   "PipelineSequence(a? b)", "a=SSF b=R", "R[a b] R[a b] F[a] halt[b]"},
  {"RoundRobin goes round for ever",
   "RoundRobin(a b)", "a=S b=S", "S[a] S[b] S[a] S[b] S[a]"},
  {"RoundRobin, Lyrical: the success of the last child is a failure",
   "RoundRobin[wrap_around=false](a b)", "a=S b=S", "S[a] F[b] S[a] F[b] S[a]"},
  {"RoundRobin fails when all have failed, counted over the ticks of an activation",
   "RoundRobin(a b c)", "a=F b=RF c=F", "R[a b] F[b c]"},
  {"RoundRobin counts in each tick anew who was skipped; an action that has failed is not begun again",
   "RoundRobin(a b c)", "a=FS b=RK c=RF", "R[a b] R[b c] F[c]"},
  {"RateController continues its period after a success in a PipelineSequence",
   "PipelineSequence(RateController[hz=5](a) b)", "a=S b=R", "R[a b] R[b] R[a b] R[b]"},
  {"RateController begins when its parent has reset it, as a ReactiveSequence does in each tick",
   "ReactiveSequence(RateController[hz=5](a) b)", "a=S b=R", "R[a b] R[a b] R[a b]"},
  {"RateController in a Sequence begins with each activation",
   "Sequence(RateController[hz=1](a))", "a=S", "S[a] S[a] S[a]"},
  {"DistanceController begins when its parent has reset it",
   "Sequence(DistanceController(a))", "a=S", "x:=0.0 y:=0.0 S[a] S[a]"},
  {"DistanceController goes on in a PipelineSequence",
   "PipelineSequence(DistanceController(a) b)", "a=S b=R", "x:=0.0 y:=0.0 R[a b] R[b] x:=1.0 R[a b]"},
  {"SpeedController begins when its parent has reset it",
   "Sequence(SpeedController[speed=0](a))", "a=S", "S[a] S[a]"},
  {"GoalUpdatedController begins when its parent has reset it",
   "Sequence(GoalUpdatedController(a))", "a=S", "S[a] S[a]"},
  {"GoalUpdatedController goes on in a PipelineSequence",
   "PipelineSequence(GoalUpdatedController(a) b)", "a=S b=R", "R[a b] R[b] goal:=1 R[a b] R[b]"},
  {"different from Nav2: a Fallback that has succeeded counts anew who is skipped",
   "PipelineSequence(Fallback(a b) c)", "a=K b=SF c=R", "R[a b c] F[a b] halt[c]"},
  {"different from Nav2: a decorator whose child was skipped begins with its next tick",
   "PipelineSequence(RateController[hz=1](a) b)", "a=KS b=R", "R[a b] R[a b] R[b]"},
  {"different from Nav2: GoalUpdated in a ReactiveFallback sees another goal. There it is reset in each tick, and fails",
   "ReactiveFallback(GoalUpdated a)", "a=R", "R[a] goal:=2 S[] halt[a]"},
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
TEST_CASE("nodes for navigation in trees for BehaviorTree.CPP") {
  check_rows(kOfNav2, FaultPolicy::Stop, btcpp::kRules);
}
// Nav2 until Kilted has no such port.
TEST_CASE("wrap_around of RoundRobin is true until Kilted, and false since Lyrical") {
  CHECK(std::string_view(nav::kRoundRobin.ports[0]->default_value) == "true");
  CHECK(std::string_view(nav::kRoundRobinOfLyrical.ports[0]->default_value) == "false");
}
TEST_CASE("RateController") {
  check_rows(kRateController);
}
TEST_CASE("SpeedController") {
  check_rows(kSpeedController);
}
TEST_CASE("DistanceController") {
  check_rows(kDistanceController);
}
TEST_CASE("GoalUpdatedController") {
  check_rows(kGoalUpdatedController);
}
TEST_CASE("GoalUpdated") {
  check_rows(kGoalUpdated);
}
TEST_CASE("GlobalUpdatedGoal") {
  check_rows(kGlobalUpdatedGoal);
}
// On a machine that is busy, ticks are left out. The nodes were ticked in the tick before all the
// same.
TEST_CASE("a late tick is no gap in the ticks") {
  using namespace std::chrono_literals;
  for (const char* const decorator :
       {"RateController[hz=1](a)", "SpeedController[speed=1](a)", "DistanceController[x=0 y=0](a)",
        "GoalUpdatedController(a)"}) {
    INFO(decorator);
    ScriptedRun run(decorator, "a=S");
    CHECK(run.tick(0s) == Status::Success);
    CHECK(run.tick(700ms) == Status::Running);
  }
  ScriptedRun run("GoalUpdated", "");
  CHECK(run.tick(0s) == Status::Failure);
  run.set("goal", std::int64_t{1});
  CHECK(run.tick(700ms) == Status::Success);
}
TEST_CASE("PathExpiringTimer") {
  check_rows(kPathExpiringTimer);
}

}  // namespace lockstep::host::test
