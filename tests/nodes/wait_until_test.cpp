// WaitUntil, and what scripts read of the run.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "support/scripted_run.h"
#include "support/tick_table.h"
#include "support/tree_document.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kWaitUntilRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"runs until its script is true, then succeeds",
   "Sequence[memory=true](Script[code=n:=0] Parallel(a[on_success=n:=1] WaitUntil[code=n==1]))",
   "a=RRS", "R[a] R[a] S[a]"},
  {"succeeds at once where it is true",
   "Sequence[memory=true](Script[code=n:=1] WaitUntil[code=n==1] a)", "a=S", "S[a]"},
  {"fails when its time is over",
   "WaitUntil[code=1>2 timeout=.2]", "", "R[] R[] F[]"},
  {"the condition comes before the time",
   "Sequence[memory=true](Script[code=n:=0] Parallel(a[on_success=n:=1] WaitUntil[code=n==1 timeout=.2]))",
   "a=RRS", "R[a] R[a] S[a]"},
  {"begins to count again in a new activation",
   "Retry[attempts=2](WaitUntil[code=1>2 timeout=.1])", "", "R[] R[] R[] F[]"},
  {"its time stands still while it is held",
   "Sequence[memory=true](Script[code=n:=0] ParallelRelative[delta=0](a WaitUntil[code=n==1 timeout=.2]))",
   "a=R~0,0,0", "R[a] R[a] F[a] halt[a]"},
  {"a script that fails is its fault",
   "Sequence(WaitUntil[code=n>1] Script[code=n:=1])", "", "X[]=WaitUntil"},
};

constexpr TickRow kReadingRows[] = {
  {"status: begins one tick after the other has succeeded, wherever it stands",
   "Parallel(Sequence[memory=true](WaitUntil[code=status(a)==success] b) Sequence[memory=true](a c))",
   "a=RS b=S c=RRR", "R[a] R[a c] R[b c] R[c]"},
  {"the order in the tree says nothing",
   "Parallel(Sequence[memory=true](a c) Sequence[memory=true](WaitUntil[code=status(a)==success] b))",
   "a=RS b=S c=RRR", "R[a] R[a c] R[c b] R[c]"},
  {"status of what has succeeded stays until its parent begins again",
   "Repeat[times=2](Sequence[memory=true](a Parallel(b Check[code=status(a)==success])))",
   "a=RS b=RRS", "R[a] F[a b] halt[b]"},
  {"a halted node is idle",
   "Parallel(Fallback(Sequence(c? a) d) WaitUntil[code=status(a)==idle])",
   "c=SSF a=R d=RS", "R[c a] R[c a] R[c d] halt[a] S[c d]"},
  {"progress: of an action",
   "Parallel(a Sequence[memory=true](WaitUntil[code=progress(a)>=0.5] b))",
   "a+.25 b=S", "R[a] R[a] R[a b] S[a]"},
  {"progress is 1 after Success and 0 after Failure",
   "Parallel[success_count=3 failure_count=3](a b Check[code=progress(a)+progress(b)<=1] c)", "a=S b=F c=RS",
   "R[a b c] S[c]"},
  {"sums of steps are the number that is meant",
   "Parallel(a Sequence[memory=true](WaitUntil[code=progress(a)==0.3] b))",
   "a+.1 b=S", "R[a] R[a] R[a] R[a b] R[a] R[a] R[a] R[a] R[a] S[a]"},
  {"progress is compared as at barriers, not as other numbers",
   "Parallel(a Sequence[memory=true](WaitUntil[code=progress(a)>=0.5&&0.4<progress(a)] b))",
   "a=R.49999995R.5RS b=S", "R[a] R[a] R[a b] S[a]"},
  {"what differs by rounding is the same progress",
   "Parallel(a Sequence[memory=true](WaitUntil[code=progress(a)==0.5] b))",
   "a=R.499999998R.4999999991RS b=S", "R[a] R[a] R[a b] S[a]"},
  {"0.499999999 has reached 0.5 for a barrier and for a script",
   "Parallel(ParallelAbsolute[barriers=.5](a b) Sequence[memory=true](WaitUntil[code=progress(a)>=0.5] c))",
   "a=R.499999999 b=RRR c=S", "R[a b] R[b c] pause[a] R[b]"},
  {"0.499999998 has not",
   "Parallel(ParallelAbsolute[barriers=.5](a b) Sequence[memory=true](WaitUntil[code=progress(a)>=0.5] c))",
   "a=R.499999998R b=RRR c=S", "R[a b] R[a b] R[a b]"},
  {"0.500000001 has not passed 0.5 for both",
   "Parallel(ParallelAbsolute[barriers=.5 at_barrier=tick](a b) Sequence[memory=true](WaitUntil[code=progress(a)>0.5] c))",
   "a=R.500000001R b=RRR c=S", "R[a b] R[a b] R[a b]"},
  {"held: a synchronized node withholds its ticks",
   "Parallel(ParallelAbsolute[barriers=.5](a b) Sequence[memory=true](WaitUntil[code=held(b)] c))",
   "a=RRRRS b=R~0,.5,.5,.5 c=S", "R[a b] R[a] pause[b] R[a c] R[a]"},
  {"owner: none, while nobody that runs has the resource",
   "Parallel(UseResources[pool=p resources=A](a) Sequence[memory=true](WaitUntil[code=owner(A)!=none] b) "
   "Sequence[memory=true](WaitUntil[code=owner(A)=='Test/Parallel/UseResources'] c) "
   "Sequence[memory=true](d WaitUntil[code=owner(A)==none] e)) resources[name=p]",
   "a=RRRS b=S c=S d=RS e=S", "R[a d] R[a b c d] R[a] R[a] S[e]"},
  {"the same for all scripts of a tick",
   "Parallel(Check[code=progress(a)<0.5] a Check[code=progress(a)<0.5])", "a+.5", "R[a] F[a]"},
  {"a leaf that cannot say its progress is at fault",
   "Parallel(a Check[code=progress(a)<2])", "a=RR<nan>R", "R[a] R[a] X{halt a}=a"},
};

// The pool q, and the barrier h, are p and g in the tree "Inner".
struct RenamedRow {
  std::string_view law, inner;
  bool reads_other;  // p, which 'a' owns, or g, where 'a' runs
};
constexpr RenamedRow kRenamedRows[] = {
  {"an attribute of a SubTree renames a pool for the scripts inside",
   R"(<Sequence memory="true"><WaitUntil code="owner(q/A)!=none"/><Scripted name="c"/></Sequence>)", true},
  {"also where the tree inside uses the pool itself",
   R"(<Sequence memory="true"><WaitUntil code="owner(q/A)!=none"/><UseResources pool="q" resources="C"><Scripted name="c"/></UseResources></Sequence>)", true},
  {"and of a pool that a node around the script has",
   R"(<UseResources pool="q" resources="C"><Scripted name="c" skip_if="owner(q/A)==none"/></UseResources>)", true},
  {"and for the trees inside of that one",
   R"(<SubTree ID="Deep"/>)", true},
  {"the names that no attribute gives are those of outside",
   R"(<Sequence memory="true"><WaitUntil code="owner(p/A)!=none"/><Scripted name="c"/></Sequence>)", true},
  {"a resource that only the pool of the other name has is that one's",
   R"(<Sequence memory="true"><WaitUntil code="owner(q/D)!=none"/><Scripted name="c"/></Sequence>)", false},
  {"likewise a barrier",
   R"(<Sequence memory="true"><WaitUntil code="status(h)==running"/><Scripted name="c"/></Sequence>)", true},
};
// clang-format on

// Whether 'c' is ticked within three ticks.
bool ticks_c(std::string_view inner) {
  const LoadedDocument loaded =
      tree_from_document(R"(<root lockstep="1" main_tree_to_execute="Test">
    <resources name="p" resources="A;C"/> <resources name="q" resources="A;C;D"/>
    <barrier name="g" delta="1"/> <barrier name="h" delta="1"/>
    <BehaviorTree ID="Test"><Parallel failure_count="4">
      <UseResources pool="p" resources="A"><SyncProgress barrier="g"><Scripted name="a"/></SyncProgress></UseResources>
      <SyncProgress barrier="g"><Scripted name="b"/></SyncProgress>
      <SubTree ID="Inner" q="p" h="g"/>
      <Delay seconds="9"><UseResources pool="q" resources="A"><Parallel>
        <SyncProgress barrier="h"><Scripted name="d"/></SyncProgress>
        <SyncProgress barrier="h"><Scripted name="e"/></SyncProgress></Parallel></UseResources></Delay>
    </Parallel></BehaviorTree>
    <BehaviorTree ID="Deep"><Sequence memory="true">
      <WaitUntil code="owner(q/A)!=none"/><Scripted name="c"/></Sequence></BehaviorTree>
    <BehaviorTree ID="Inner">)" +
                         std::string(inner) + "</BehaviorTree></root>");
  CAPTURE(loaded.errors);
  REQUIRE(loaded.tree);
  ScriptedRun run(*loaded.tree, "a=R b=R c=R d=R e=R");
  for (int tick = 0; tick < 3; ++tick) run.tick(tick * std::chrono::milliseconds(100));
  return std::ranges::any_of(run.events, [&](const Event& it) {
    return it.call == Call::Tick && run.leaf_name(it.leaf) == "c";
  });
}

}  // namespace

TEST_CASE("WaitUntil") {
  check_rows(kWaitUntilRows);
}

TEST_CASE("what scripts read of the run") {
  check_rows(kReadingRows);
}

TEST_CASE("what scripts read of the run has the names of their SubTree") {
  for (const RenamedRow& row : kRenamedRows) {
    INFO(row.law);
    CHECK(ticks_c(row.inner) == row.reads_other);
  }
}

}  // namespace lockstep::host::test
