// What the engine does for control nodes and decorators of plugins, and what it makes of those that
// break the contract.
#include <catch2/catch.hpp>

#include "nodes/control_nodes.h"
#include "support/plugin_nodes.h"
#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

const KnownPlugin kKnown(kControlNodes);

// clang-format off
constexpr TickRow kPluginControlRows[] = {
  {"ticks its children when it wants to",
   "InOrder(a b)", "a=RS b=RS", "R[a] R[a b] S[a b]"},
  {"begins a new activation of a completed child that it ticks again",
   "InOrder(a b)", "a=S b=R", "R{start a, tick a, start b, tick b} R{start a, tick a, tick b}"},
  {"may leave a child that runs without ticks",
   "InOrder(a b)", "a=SR b=R", "R[a b] R[a]"},
  {"halts the children that run when it completes, after its tick",
   "First(a b c)", "a=RS b=R c=S", "R[a b c] S[a b c] halt[b]"},
  {"is halted with its children",
   "Sequence(c? First(a b))", "c=SF a=R b=R", "R[c a b] F[c] halt[a b]"},
  {"is paused with its children",
   "ParallelAbsolute[barriers=.5](First(a b) c)", "a=R.6RS b=R.6RS c=R.1R.6S",
   "R[a b c] R[c] pause[a b] R[a b c] resume[a b]"},
  {"has the least progress of its children that run",
   "First(a b c)", "a=R.4 b=R.2 c=S", "R[a b c]=.2"},
  {"has no progress while none of its children runs",
   "Every(a)", "a=S", "S[a]=1"},
  {"pauses and resumes a child",
   "Every(a)", "a=R", "R{start a, tick a} R{pause a} R{resume a, tick a} R{pause a}"},
  {"halts a child, which is idle then",
   "Halts(a)", "a=R", "R[a] R[] halt[a] R{start a, tick a}"},
  {"below a leaf at fault does not complete",
   "InOrder(a b)", "a=x b=S", "X[]=a"},
  {"stays Running above a leaf at fault",
   "First(a b c)", "a=S b=x c=R", "X[a]=b"},

  {"does not reach its children from another thread",
   "OtherThread(a)", "a=S", "R[] R[]"},

  {"ticks a child twice", "Breach[what=twice](a b)", "a=S b=S", "X[a]=Breach"},
  {"ticks a child that it does not have", "Breach[what=index](a b)", "a=S b=S", "X[]=Breach"},
  {"ticks a child outside of its tick", "Breach[what=tick_in_start](a b)", "a=S b=S", "X[]=Breach"},
  {"asks for a child that it does not have", "Breach[what=](a b)", "a=S b=S", "X[a]=Breach"},
  {"throws", "Breach[what=after](a b)", "a=S b=S", "X[]=Breach"},
  {"returns a status that is no result", "Breach[what=status](a b)", "a=S b=S", "X[]=Breach"},
};

constexpr TickRow kFailRows[] = {
  {"at fault fails, and its children are halted",
   "Fallback(Breach[what=twice](a b) c)", "a=R b=S c=S", "S[a c]!Breach halt[a]"},
  {"at fault in its halt: its children are halted all the same",
   "Sequence(c? TickInHalt(a))", "c=SF a=R", "R[c a] F[c]!TickInHalt halt[a]"},
};
// clang-format on

// The message of the fault that the first tick ends in.
std::string fault_of(std::string_view tree) {
  ScriptedRun run(tree, "a=S b=S");
  run.tick(Nanoseconds(0));
  return run.ticker().fault() == nullptr ? "none" : run.ticker().fault()->message;
}

}  // namespace

TEST_CASE("control nodes of plugins") {
  check_rows(kPluginControlRows);
  check_rows(kFailRows, FaultPolicy::Fail);
}

TEST_CASE("a control node that breaks the contract is at fault, by name of what it did") {
  CHECK(fault_of("Breach[what=twice](a b)") == "ticks child 0 twice in one tick");
  CHECK(fault_of("Breach[what=index](a b)") == "ticks child 7, but has 2 children, counted from 0");
  CHECK(fault_of("Breach[what=tick_in_start](a b)") == "ticks a child outside of its tick");
  CHECK(fault_of("Breach[what=](a b)") == "requests child 2, but has 2 children, counted from 0");
  CHECK(fault_of("Breach[what=status](a b)") ==
        "returned status 0, expected one of lockstep/leaf.h");
}

TEST_CASE("children are halted and paused before their control node, and resumed after it") {
  ScriptedRun run("ParallelAbsolute[barriers=.5](Watching(a) b)", "a=R.6 b=R.1R.6");
  std::string seen;
  watching_seen = [&](const char* function) {
    seen += std::string(function) + " after " + std::to_string(run.events.size()) + ";";
  };
  run.tick(Nanoseconds(0));
  run.events.clear();
  run.tick(Nanoseconds(1));
  CHECK(seen == "pause after 1;");
  run.events.clear();
  seen.clear();
  run.tick(Nanoseconds(2));
  CHECK(seen == "resume after 0;");
  run.events.clear();
  seen.clear();
  run.ticker().halt_all();
  CHECK(seen == "halt after 1;");
}

}  // namespace lockstep::host::test
