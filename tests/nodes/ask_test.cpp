// Ask: a person chooses one of its options.
#include <catch2/catch.hpp>

#include "run/shape_of.h"
#include "support/scripted_run.h"
#include "support/tick_table.h"

namespace lockstep::host::test {
namespace {

// clang-format off
constexpr TickRow kAskRows[] = {
//  law
//    tree  |  leaves, tick by tick  |  expected
  {"runs until somebody answers",
   "Ask[text=Now?]", "", "R[]=0 R[] R[]"},
  {"fails when nobody has answered in time",
   "Ask[text=Now? timeout=.2]", "", "R[] R[] F[]"},
  {"has its default then: the first option is Success",
   "Ask[text=Now? timeout=.1 default=yes]", "", "R[] S[]"},
  {"and each other option is Failure",
   "Ask[text=Now? timeout=.1 default=no]", "", "R[] F[]"},
  {"with an entry for the answer, each option is Success",
   "Sequence[memory=true](Script[code=n:=''] Ask[text=Now? timeout=.1 default=no answer={n}] Check[code=n=='no'] a)",
   "a=S", "R[] S[a]"},
  {"counts again in a new activation",
   "Retry[attempts=2](Ask[text=Now? timeout=.1])", "", "R[] R[] R[] F[]"},
  {"its time stands still while it is held",
   "ParallelAbsolute[barriers=.5](a Sequence[memory=true](b Ask[text=Now? timeout=.2]))",
   "a=R.1R.1R.1R.1R.6RR b=S", "R[a b] R[a] R[a] R[a] R[a] R[a] F[a] halt[a]"},
  {"in a question, an entry without a value is shown as its key",
   "Sequence(Ask[text={n}? timeout=.1] Script[code=n:=1])", "", "R[] F[]"},
};
// clang-format on

constexpr Nanoseconds kAskPeriod = std::chrono::milliseconds(100);

// A run of one Ask, or of a tree in which node 1 is one.
class Asking {
 public:
  explicit Asking(std::string_view tree) : run_(tree, "") {}
  Status tick() { return run_.tick(kAskPeriod * count_++); }
  bool answer(NodeIndex node, std::uint32_t option) {
    return answer(node, option, run_.ticker().tick_number());
  }
  bool answer(NodeIndex node, std::uint32_t option, std::uint32_t seen) {
    return run_.ticker().answer(node, {option, option == 0 ? "yes" : "no", "test"}, seen);
  }
  std::string reason(NodeIndex node) {
    for (const Reason& it : run_.ticker().reasons()) {
      if (it.node == node && it.number == run_.ticker().tick_number()) return it.text;
    }
    return {};
  }
  ScriptedRun& run() { return run_; }

 private:
  ScriptedRun run_;
  int count_ = 0;
};

}  // namespace

TEST_CASE("Ask: without an answer") {
  check_rows(kAskRows);
}

TEST_CASE("Ask: an answer counts in the next tick") {
  const auto option = GENERATE(0u, 1u);
  Asking run("Ask[text=Now?]");
  CHECK_FALSE(run.answer(0, option));  // nobody has asked yet
  CHECK(run.tick() == Status::Running);
  CHECK(run.reason(0) == "Now?");
  CHECK(run.tick() == Status::Running);
  CHECK(run.reason(0) == "Now?");
  CHECK(run.answer(0, option));
  CHECK_FALSE(run.answer(0, 1 - option));  // the first one counts
  CHECK(run.tick() == (option == 0 ? Status::Success : Status::Failure));
  CHECK(run.reason(0) == (option == 0 ? "answered 'yes'" : "answered 'no'"));
  const auto given = run.run().ticker().answers();
  REQUIRE(given.size() == 1);
  CHECK(given[0].answer == (option == 0 ? "yes" : "no"));
  CHECK(given[0].who == "test");
}

TEST_CASE("Ask: an answer before the end of the time counts in the tick in which it is over") {
  Asking run("Ask[text=Now? timeout=.1 default=no]");
  run.tick();
  CHECK(run.answer(0, 0));
  CHECK(run.tick() == Status::Success);
}

TEST_CASE("Ask: what came with an earlier question is no answer to a later one") {
  Asking run("Retry[attempts=3](Ask[text=Now?])");
  run.tick();
  const std::uint32_t seen = run.run().ticker().tick_number();
  CHECK(run.answer(1, 1));
  run.tick();  // Failure
  CHECK_FALSE(run.answer(1, 0));
  run.tick();  // asks again
  CHECK_FALSE(run.answer(1, 0, seen));
  CHECK(run.answer(1, 0));
  CHECK(run.tick() == Status::Success);
}

TEST_CASE("Ask: the question has the values of entries, as they were when it was asked") {
  Asking run("Sequence[memory=true](Script[code=n:=2;part:='gear'] Ask[text=Take_{n}_of_{part}?])");
  run.run().ticker();
  run.tick();
  CHECK(run.reason(2) == "Take_2_of_gear?");
}

TEST_CASE("Ask: the shape of a tree says which answers there are") {
  Asking run("Ask[text=Now? options=left;right;stop default=stop timeout=3 severity=critical]");
  const Shape shape = shape_of(run.run().tree());
  REQUIRE(shape.nodes[0].question);
  const NodeQuestion& it = *shape.nodes[0].question;
  CHECK(it.options == std::vector<std::string>{"left", "right", "stop"});
  CHECK(it.fallback == "stop");
  CHECK(it.timeout == 3.0);
  CHECK(it.severity == "critical");
}

TEST_CASE("Ask: options and default must fit") {
  CHECK_THROWS(Asking("Ask[text=Now? options=a;a]"));
  CHECK_THROWS(Asking("Ask[text=Now? timeout=1 default=maybe]"));
  CHECK_THROWS(Asking("Ask[text=Now? default=yes]"));
}

}  // namespace lockstep::host::test
