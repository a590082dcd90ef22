// docs/deadlocks.md: nodes that hold each other in a circle. Each tree is checked and run: those
// that are warned of stand still, the others end.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

struct Circle {
  std::string_view claim, barriers, tree, circle;
};

std::string document(const Circle& row) {
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

constexpr Circle kCircles[] = {
    {"a member is inside of what an outer barrier holds", kCoarseAndFine, R"(<Parallel>
       <SyncProgress name="c1" barrier="coarse"><SyncProgress name="f1" barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress name="c2" barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
         <SyncProgress name="f2" barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence>
       </SyncProgress></Parallel>)",
     "coarse -> fine -> coarse"},
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
     "r -> g -> h -> r"},
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
     "r -> g -> q -> h -> r"},
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
     "coarse -> fine -> coarse"},
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
     "coarse -> fine -> coarse"},
    {"in whatever order they stand", kCoarseAndFine, R"(<Parallel>
       <SyncProgress name="c1" barrier="coarse"><SyncProgress name="f1" barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress name="c2" barrier="coarse"><Parallel>
         <Sequence memory="true"><Advance step="0.05"/>
           <SyncProgress name="f2" barrier="fine"><Advance step="0.05"/></SyncProgress>
         </Sequence><Advance step="0.05"/></Parallel></SyncProgress></Parallel>)",
     "coarse -> fine -> coarse"},
    {"not where one of them is before the barrier until the other member has come", kCoarseAndFine,
     R"(<Parallel>
       <SyncProgress barrier="coarse"><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress></SyncProgress>
       <SyncProgress barrier="coarse"><Parallel><SyncProgress barrier="fine">
         <Advance step="0.05"/></SyncProgress>
         <Advance step="0.05"/></Parallel></SyncProgress></Parallel>)",
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
  constexpr std::string_view kWarning = "held nodes may deadlock: ";
  const auto at = told.find(kWarning);
  return at == std::string::npos ? told : told.substr(at + kWarning.size());
}

TEST_CASE("held nodes: a circle is warned of, and stands still, and what ends is not") {
  for (const Circle& row : kCircles) {
    INFO(row.claim);
    Pipeline pipeline(document(row));
    pipeline.advise();
    CHECK(circle_of(pipeline) == row.circle);
    CHECK(pipeline.run().starts_with(row.circle.empty() ? "success" : "running"));
  }
}

TEST_CASE("held nodes: the hint explains the circle, with places") {
  Pipeline pipeline(document(kCircles[0]));
  pipeline.advise();
  REQUIRE(pipeline.diagnostics().all().size() == 1);
  const Diagnostic& told = pipeline.diagnostics().all().front();
  CHECK(told.severity == Severity::Warning);
  CHECK(told.location.line == 4);
  CHECK(told.hint ==
        "'coarse' holds 'c2' at 0.5 until 'c1' comes, which is at 0.25 and has 'f1' in it; "
        "'fine' holds 'f1' at 0.25 until 'f2' comes, which is at 0 and is inside of 'c2'");
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
  Pipeline pipeline(document(kCircles[4]));
  pipeline.advise();
  REQUIRE(pipeline.diagnostics().all().size() == 1);
  CHECK(pipeline.diagnostics().all().front().hint ==
        "'r' holds 's' at 0.61 until 'g1' comes, which is at 0.5; 'g' holds 'g1' at 0.5 until 'g2' "
        "comes, which does not run and comes after 'h2'; 'h' holds 'h2' at 0.5 until 'h1' comes, "
        "which is at 0.22 and is inside of 's'");
}

TEST_CASE("held nodes: an action without progress is at no barrier before it succeeds") {
  Pipeline pipeline(R"(<root lockstep="1"><plugin name="motion"/><plugin name="robot"/>
    <barrier name="coarse" barriers="0.5"/><barrier name="fine" barriers="0.25"/>
    <BehaviorTree ID="T"><Parallel>
    <SyncProgress barrier="coarse"><SyncProgress barrier="fine"><Say text="x"/></SyncProgress>
    </SyncProgress>
    <SyncProgress barrier="coarse"><Sequence memory="true"><Advance step="0.05"/>
      <SyncProgress barrier="fine"><Advance step="0.05"/></SyncProgress></Sequence></SyncProgress>
    </Parallel></BehaviorTree></root>)");
  pipeline.advise();
  CHECK(pipeline.told().find("warning") == std::string::npos);
  CHECK(pipeline.run().starts_with("success"));
}

TEST_CASE("held nodes: also below a node that may do without the member") {
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
    Pipeline pipeline(with_inner(around, kCoarseAndFine, "0.05"),
                      around.find("{n}") == std::string_view::npos ? "" : "set.n=1");
    pipeline.advise();
    CHECK(circle_of(pipeline) == "coarse -> fine -> coarse");
    CHECK(pipeline.run() == "running 100");
  }
}

TEST_CASE("held nodes: limits from an entry are its start value") {
  constexpr std::string_view kBarriers =
      R"(<barrier name="coarse" barriers="{c}"/><barrier name="fine" barriers="0.25"/>)";
  Pipeline pipeline(with_inner("%", kBarriers, "0.05"), "set.c=0.5");
  pipeline.advise();
  CHECK(circle_of(pipeline) == "coarse -> fine -> coarse");
  CHECK(pipeline.run() == "running 100");
}

TEST_CASE("held nodes: a tree that is warned of may end where steps are large") {
  Pipeline pipeline(with_inner("%", kCoarseAndFine, "0.3"));
  pipeline.advise();
  CHECK(circle_of(pipeline) == "coarse -> fine -> coarse");
  CHECK(pipeline.run().starts_with("success"));
}

TEST_CASE("held nodes: where what is idle is ignored, it depends on who is faster") {
  constexpr std::string_view kIgnores =
      R"(<barrier name="coarse" barriers="0.5"/>
         <barrier name="fine" barriers="0.25" idle="ignore"/>)";
  Pipeline slow(with_inner("%", kIgnores, "0.05"));
  slow.advise();
  CHECK(circle_of(slow) == "coarse -> fine -> coarse");
  CHECK(slow.run().starts_with("success"));
  std::string fast = with_inner("%", kIgnores, "0.05");
  fast.replace(fast.rfind("0.05", fast.rfind("0.05") - 1), 4, "0.5");
  CHECK(Pipeline(fast).run().starts_with("running"));
}

}  // namespace
}  // namespace lockstep::host::test
