// docs/nodes-and-attributes.md: what its sections on nodes and progress say of documents. The laws
// of the nodes themselves are in tests/nodes.
#include <catch2/catch.hpp>

#include "language/pipeline.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("runs of trees with leaves of plugins") {
  constexpr ClaimRow kRows[] = {
      {"without memory an action before an action is started again and again",
       R"(<Sequence><Say text="a"/><GoTo target="b" speed="0.5"/></Sequence>)",
       "success 2: a, go to b, a"},
      {"with memory it is not",
       R"(<Sequence memory="true"><Say text="a"/><GoTo target="b" speed="0.5"/></Sequence>)",
       "success 2: a, go to b"},
      {"the memory ends with the activation",
       R"(<Repeat times="2"><Sequence memory="true"><Say text="a"/><GoTo target="b" speed="0.5"/>
          </Sequence></Repeat>)",
       "success 4: a, go to b, a, go to b"},
      {"a node that completed is started anew",
       R"(<Repeat times="2"><GoTo target="b" speed="1"/></Repeat>)", "success 2: go to b, go to b"},
      {"Repeat without times goes on for ever", R"(<Repeat><AlwaysSuccess/></Repeat>)",
       "running 100"},
      {"an iteration costs a tick", R"(<Retry attempts="3"><AlwaysFailure/></Retry>)", "failure 3"},
      {"times are in seconds: 10 ticks of 0.01 s", R"(<Wait seconds="0.1"/>)", "success 11"},
      {"a tree inside a tree is one node of it",
       R"(<root lockstep="1" main_tree_to_execute="M"><BehaviorTree ID="M"><Inverter>
          <SubTree ID="S"/></Inverter></BehaviorTree>
          <BehaviorTree ID="S"><IsOpen/></BehaviorTree></root>)",
       "success 1"},
  };
  check_runs(kRows);
}

// The first child is at 1/2 after two ticks, exactly; the second not before its third.
std::string at_half(std::string_view synchronized) {
  return "<" + std::string(synchronized) +
         R"(><Sequence memory="true"><GoTo target="a" speed="0.5"/><GoTo target="b" speed="0.5"/>
            <Say text="b done"/></Sequence><Sequence memory="true"><Wait seconds="0.03"/>
            <Say text="late"/><GoTo target="c" speed="0.5"/></Sequence></)" +
         std::string(synchronized.substr(0, synchronized.find(' '))) + ">";
}

TEST_CASE("the synchronized nodes, as a document gives them") {
  struct Row {
    std::string_view claim, node, expected;
  };
  constexpr std::string_view kHeld = "success 5: go to a, go to b, late, go to c, b done";
  constexpr std::string_view kFree = "success 5: go to a, go to b, b done, late, go to c";
  constexpr Row kRows[] = {
      {"a child waits at a barrier", "ParallelAbsolute barriers='0.5'", kHeld},
      {"which is the default of at_barrier", "ParallelAbsolute barriers='0.5' at_barrier='wait'",
       kHeld},
      {"tick: exactly at the barrier it goes on",
       "ParallelAbsolute barriers='0.5' at_barrier='tick'", kFree},
      {"barrier_count 2 is 0.5 and 1", "ParallelAbsolute barrier_count='2'", kHeld},
      {"the tolerance is 1e-9", "ParallelAbsolute barriers='0.5000000001'", kHeld},
      {"and no more", "ParallelAbsolute barriers='0.50000001'", kFree},
      {"a barrier that comes later holds nobody yet", "ParallelAbsolute barriers='0.9'", kFree},
      {"no barriers are a plain parallel", "ParallelAbsolute barriers=''", kFree},
      {"delta: nobody runs ahead by more", "ParallelRelative delta='0.1'",
       "success 6: go to a, go to b, late, go to c, b done"},
      {"delta 1 holds nobody", "ParallelRelative delta='1'", kFree},
  };
  for (const Row& row : kRows) {
    INFO(row.claim);
    CHECK(Pipeline(at_half(row.node)).run() == row.expected);
  }
}

TEST_CASE("a fault ends the run, it is not a Failure") {
  constexpr ClaimRow kRows[] = {
      {"not even under ForceSuccess", R"(<ForceSuccess><GoTo target="{x}"/></ForceSuccess>)",
       "fault: port 'target' has no value: nothing has written the entry '{x}'"},
      {"nothing is ticked after it",
       R"(<Parallel><GoTo target="{x}"/><Say text="still here"/></Parallel>)",
       "fault: port 'target' has no value: nothing has written the entry '{x}'"},
  };
  check_runs(kRows);
}

}  // namespace
}  // namespace lockstep::host::test
