// docs/language.md: nodes that hold each other in a circle. Each tree is checked and run: those
// that are warned of stand still, the others end.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

struct Row {
  std::string_view claim, barriers, tree, circle;
};

std::string document(const Row& row) {
  return fmt::format(
      "<root lockstep=\"1\"><plugin name=\"motion\"/>{}<BehaviorTree ID=\"T\">{}</BehaviorTree>"
      "</root>",
      row.barriers, row.tree);
}

constexpr std::string_view kCoarseAndFine =
    R"(<barrier name="coarse" barriers="0.5"/><barrier name="fine" barriers="0.25"/>)";
constexpr std::string_view kCoarseAndLate =
    R"(<barrier name="coarse" barriers="0.5"/><barrier name="late" barriers="0.75"/>)";
constexpr std::string_view kTwo =
    R"(<barrier name="g" barriers="0.5"/><barrier name="h" barriers="0.5"/>)";

constexpr Row kRows[] = {
    {"a member is inside of what an outer barrier holds", kCoarseAndFine, R"(<Parallel>
       <SyncProgress name="c1" barrier="coarse"><SyncProgress name="f1" barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress name="c2" barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress name="f2" barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     "fine -> coarse -> fine"},
    {"not where it passes the inner barrier before the outer one holds it", kCoarseAndFine,
     R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true">
         <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress>
         <Advance step="0.05"/></Sequence>
       </SyncProgress></Parallel>)",
     ""},
    {"not where the others reach the outer barrier before they wait at the inner one",
     kCoarseAndLate, R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="late">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress barrier="late"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     ""},
    {"not where the inner barrier is pulled down to before the outer one", kCoarseAndFine,
     R"(<Parallel>
       <SyncProgress barrier="coarse"><Sequence memory="true">
         <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress>
         <Advance step="0.05"/><Advance step="0.05"/></Sequence></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress>
         <Advance step="0.05"/></Sequence>
       </SyncProgress></Parallel>)",
     ""},
    {"through a Sequence and a ParallelRelative", kTwo, R"(<Parallel>
       <ParallelRelative name="r" delta="0.1">
         <SyncProgress name="g1" barrier="g"><Advance step="0.05"/></SyncProgress>
         <Sequence name="s" memory="true"><Advance step="0.05"/>
           <SyncProgress name="h1" barrier="h"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelRelative>
       <Sequence name="t" memory="true">
         <SyncProgress name="h2" barrier="h"><Advance step="0.05"/></SyncProgress>
         <SyncProgress name="g2" barrier="g"><Advance step="0.05"/></SyncProgress>
       </Sequence></Parallel>)",
     "g -> h -> r -> g"},
    {"not with a delta that lets it come to the other barrier", kTwo, R"(<Parallel>
       <ParallelRelative delta="0.4">
         <SyncProgress barrier="g"><Advance step="0.05"/></SyncProgress>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress barrier="h"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelRelative>
       <Sequence memory="true">
         <SyncProgress barrier="h"><Advance step="0.05"/></SyncProgress>
         <SyncProgress barrier="g"><Advance step="0.05"/></SyncProgress>
       </Sequence></Parallel>)",
     ""},
    {"through two ParallelAbsolute", kTwo, R"(<Parallel>
       <ParallelAbsolute name="r" barriers="0.6">
         <SyncProgress name="g1" barrier="g"><Advance step="0.05"/></SyncProgress>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress name="h1" barrier="h"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelAbsolute>
       <ParallelAbsolute name="q" barriers="0.6">
         <SyncProgress name="h2" barrier="h"><Advance step="0.05"/></SyncProgress>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress name="g2" barrier="g"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelAbsolute></Parallel>)",
     "g -> q -> h -> r -> g"},
    {"not with barriers that let one of them come to the other barrier", kTwo, R"(<Parallel>
       <ParallelAbsolute barriers="0.6">
         <SyncProgress barrier="g"><Advance step="0.05"/></SyncProgress>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress barrier="h"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelAbsolute>
       <ParallelAbsolute barriers="0.75">
         <SyncProgress barrier="h"><Advance step="0.05"/></SyncProgress>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress barrier="g"><Advance step="0.05"/></SyncProgress></Sequence>
       </ParallelAbsolute></Parallel>)",
     ""},
    {"the first of two rounds comes to half of the progress",
     R"(<barrier name="coarse" barriers="0.4"/><barrier name="fine" barriers="0.25"/>)",
     R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Repeat times="2"><Sequence memory="true">
         <Advance step="0.1"/>
         <SyncProgress barrier="fine"><Advance step="0.1"/></SyncProgress></Sequence></Repeat>
       </SyncProgress></Parallel>)",
     ""},
    {"rounds of a Repeat are parts of its progress", kCoarseAndFine, R"(<Parallel>
       <SyncProgress barrier="coarse"><Repeat times="2"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></Repeat></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true">
         <Repeat times="2"><Advance step="0.05"/></Repeat>
         <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     "fine -> coarse -> fine"},
    {"at a barrier with at_barrier=tick it goes on until it is behind it",
     R"(<barrier name="outer" barriers="0.5" at_barrier="tick"/>
        <barrier name="inner" barriers="0.5"/>)",
     R"(<Parallel>
       <SyncProgress barrier="outer"><SyncProgress barrier="inner">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="outer"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress barrier="inner"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     ""},
    {"several at a time are held when the last of them is at the barrier", kCoarseAndFine,
     R"(<Parallel>
       <SyncProgress name="c1" barrier="coarse"><SyncProgress name="f1" barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress name="c2" barrier="coarse"><Parallel><Advance step="0.05"/>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress name="f2" barrier="fine"><Advance step="0.05"/></SyncProgress>
         </Sequence></Parallel></SyncProgress></Parallel>)",
     "fine -> coarse -> fine"},
    {"in whatever order they stand", kCoarseAndFine, R"(<Parallel>
       <SyncProgress name="c1" barrier="coarse"><SyncProgress name="f1" barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress name="c2" barrier="coarse"><Parallel>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress name="f2" barrier="fine"><Advance step="0.05"/></SyncProgress>
         </Sequence><Advance step="0.05"/></Parallel></SyncProgress></Parallel>)",
     "fine -> coarse -> fine"},
    {"not where one of them is before the barrier until the other member has come", kCoarseAndFine,
     R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Parallel><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress>
         <Advance step="0.05"/></Parallel></SyncProgress></Parallel>)",
     ""},
    {"not where what is idle is ignored",
     R"(<barrier name="coarse" barriers="0.5"/>
        <barrier name="fine" barriers="0.25" idle="ignore"/>)",
     R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.1"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     ""},
    {"not where an action at the barrier completes at once", kCoarseAndFine, R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress barrier="fine"><AlwaysSuccess/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     ""},
};

// What is told, without the place.
std::string circle_of(const Pipeline& pipeline) {
  const std::string told = pipeline.told();
  constexpr std::string_view kWarning = "held nodes may wait for each other in a circle: ";
  const auto at = told.find(kWarning);
  return at == std::string::npos ? told : told.substr(at + kWarning.size());
}

TEST_CASE("held nodes: a circle is warned of, and stands still, and what ends is not") {
  for (const Row& row : kRows) {
    INFO(row.claim);
    const Pipeline pipeline(document(row));
    CHECK(circle_of(pipeline) == row.circle);
    CHECK(pipeline.run().starts_with(row.circle.empty() ? "success" : "running"));
  }
}

TEST_CASE("held nodes: the hint explains the circle, with places") {
  const Pipeline pipeline(document(kRows[0]));
  REQUIRE(pipeline.diagnostics().all().size() == 1);
  const Diagnostic& told = pipeline.diagnostics().all().front();
  CHECK(told.severity == Severity::Warning);
  CHECK(told.location.line == 2);
  CHECK(told.hint ==
        "'f1' at tree.xml:2:49 is held by 'fine' at 0.25 until 'f2' at tree.xml:5:10 is there, "
        "which is inside of what 'coarse' holds; 'c2' at tree.xml:4:8 is held by 'coarse' at 0.5 "
        "until 'c1' at tree.xml:2:8 is there, in which 'fine' holds a node");
}

// The first tree, with y and its member inside of `%`.
std::string with_inner(std::string_view around, std::string_view barriers, std::string_view step) {
  std::string inner(around);
  inner.replace(
      inner.find('%'), 1,
      fmt::format("<SyncProgress barrier=\"fine\"><Advance step=\"{}\"/></SyncProgress>", step));
  return fmt::format(R"(<root lockstep="1"><plugin name="motion"/>{}<BehaviorTree ID="T"><Parallel>
    <SyncProgress barrier="coarse"><SyncProgress barrier="fine"><Advance step="0.05"/>
    </SyncProgress></SyncProgress>
    <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>{}</Sequence>
    </SyncProgress></Parallel></BehaviorTree></root>)",
                     barriers, inner);
}

TEST_CASE("held nodes: the hint says what comes before whom in a Sequence") {
  const Pipeline pipeline(document(kRows[4]));
  REQUIRE(pipeline.diagnostics().all().size() == 1);
  CHECK(
      pipeline.diagnostics().all().front().hint ==
      "'g1' at tree.xml:3:10 is held by 'g' at 0.5 until 'g2' at tree.xml:9:10 is there, which "
      "comes after 'h2' in 't'; 'h2' at tree.xml:8:10 is held by 'h' at 0.5 until 'h1' at "
      "tree.xml:5:12 is there, which is inside of what 'r' holds; 's' at tree.xml:4:10 is held by "
      "'r' beyond 0.6 until 'g1' at tree.xml:3:10 is there");
}

TEST_CASE("held nodes: an action without progress is at no barrier before it succeeds") {
  const Pipeline pipeline(R"(<root lockstep="1"><plugin name="motion"/><plugin name="robot"/>
    <barrier name="coarse" barriers="0.5"/><barrier name="fine" barriers="0.25"/>
    <BehaviorTree ID="T"><Parallel>
    <SyncProgress barrier="coarse"><SyncProgress barrier="fine"><Say text="x"/></SyncProgress>
    </SyncProgress>
    <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
      <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence></SyncProgress>
    </Parallel></BehaviorTree></root>)");
  CHECK(pipeline.told().find("warning") == std::string::npos);
  CHECK(pipeline.run().starts_with("success"));
}

TEST_CASE("held nodes: nobody waits for a member that a node may do without") {
  constexpr std::string_view kAround[] = {
      R"(<Fallback memory="true">%<AlwaysSuccess/></Fallback>)",
      R"(<IfThenElse><Check code="true"/>%</IfThenElse>)",
      R"(<WhileDoElse><Check code="true"/>%</WhileDoElse>)",
      R"(<Switch on="1" cases="1">%</Switch>)",
      R"(<Parallel success_count="1">%<Advance step="0.001"/></Parallel>)",
      R"(<Parallel memory="false">%</Parallel>)",
      R"(<Repeat times="{n}">%</Repeat>)",
      R"(<Sequence skip_if="false">%</Sequence>)",
  };
  for (const std::string_view around : kAround) {
    INFO(around);
    const Pipeline pipeline(with_inner(around, kCoarseAndFine, "0.05"),
                            around.find("{n}") == std::string_view::npos ? "" : "set.n=1");
    CHECK(pipeline.told().find("circle") == std::string::npos);
    CHECK(pipeline.run() == "running 100");
  }
}

TEST_CASE("held nodes: limits from an entry hold nobody when the tree is loaded") {
  constexpr std::string_view kBarriers =
      R"(<barrier name="coarse" barriers="{c}"/><barrier name="fine" barriers="0.25"/>)";
  const Pipeline pipeline(with_inner("%", kBarriers, "0.05"), "set.c=0.5");
  CHECK(pipeline.told().empty());
  CHECK(pipeline.run() == "running 100");
}

TEST_CASE("held nodes: a tree that is warned of may end where steps are large") {
  const Pipeline pipeline(with_inner("%", kCoarseAndFine, "0.3"));
  CHECK(circle_of(pipeline) == "fine -> coarse -> fine");
  CHECK(pipeline.run().starts_with("success"));
}

}  // namespace
}  // namespace lockstep::host::test
