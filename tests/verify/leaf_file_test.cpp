// What a leaf file says, and that each mistake in one is told at its place.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "leaves/leaf_script.h"
#include "leaves/models.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

struct Read {
  Diagnostics diagnostics;
  LeafModels models;
  std::vector<NodeProblem> problems;
};

Read read(std::string_view rows, std::string_view tree) {
  Read read;
  const Tree compiled = tree_from_text(tree);
  const std::string text = "<leaves lockstep=\"1\">\n" + std::string(rows) + "\n</leaves>";
  const auto file = read_leaf_file("t.leaves.xml", text, read.diagnostics);
  if (file != nullptr) {
    read.models = make_models(compiled, file.get(), read.diagnostics, read.problems);
  }
  return read;
}

LeafModel model_of(std::string_view attributes, std::string_view tree) {
  Read it = read("<leaf path=\"*\" " + std::string(attributes) + "/>", tree);
  INFO(attributes);
  REQUIRE_FALSE(it.diagnostics.has_errors());
  return it.models.leaves.at(0);
}

struct Mistake {
  std::string_view rows, at, message, hint;
};

// clang-format off
constexpr Mistake kMistakes[] = {
  {R"(<leef of="a"/>)", "2:1", "unknown element 'leef'", "did you mean 'leaf'?"},
  {R"(<leaf path="*" tick="3"/>)", "2:16", "unknown attribute 'tick' of 'leaf'", "did you mean 'ticks'?"},
  {R"(<leaf of="a" path="b"/>)", "2:1", "give exactly one of 'of' and 'path'", ""},
  {R"(<leaf result="failure"/>)", "2:1", "give exactly one of 'of' and 'path'", ""},
  {R"(<leaf of="b"/>)", "2:11", "the tree has no leaf of type 'b'", "its leaves: 'Scripted'"},
  {R"(<leaf path="*/aa"/>)", "2:13", "no leaf has the path '*/aa'", ""},
  {R"(<leaf path="*" result="succes"/>)", "2:24", "'succes' is not a result", "did you mean 'success'?"},
  {R"(<leaf path="*" ticks="0"/>)", "2:23", "'0' is not a range", "write 1..5, 3 or 2..inf"},
  {R"(<leaf path="*" ticks="5..2"/>)", "2:23", "'5..2' is not a range", "write 1..5, 3 or 2..inf"},
  {R"(<leaf path="*" ends="maybe"/>)", "2:22", "'ends' cannot be 'maybe'", "it can be: 'yes', 'no'"},
  {R"(<leaf path="*" progress="grid:0"/>)", "2:26", "'grid:0' is not a kind of progress", "write none, cuts, or grid:10 (at most 1000 parts)"},
  {R"(<leaf path="*" held="0..inf"/>)", "2:22", "'held' has no end", "still or -1..0"},
  {R"(<leaf path="*" fact="day"/>)", "2:22", "unknown fact 'day'", "declare it: <fact name=\"day\"/>"},
  {R"(<fact name="day"/><leaf path="*" fact="dya"/>)", "2:40", "unknown fact 'dya'", "did you mean 'day'?"},
  {R"(<fact name="day"/><fact name="day"/>)", "2:31", "fact 'day' is declared twice", ""},
  {R"(<leaf path="*" sets="day"/>)", "2:22", "'day' does not set a fact", "write charged=true, or charged=true;seen=false"},
  {R"(<leaf path="*" out.x="1"/>)", "2:16", "'Scripted' has no output 'x'", ""},
  {R"(<accept finding="trap"/>)", "2:1", "'accept' needs the attribute 'because'", ""},
  {R"(<tree ends=""/>)", "2:13", "'ends' is empty", ""},
  {R"(<leaf path="*" result="success:0.7;failure:0.2"/>)", "2:24", "the chances add up to 0.9, not to 1", "write success:0.7;failure:0.3"},
  {R"(<leaf path="*" result="success:0.7;failure"/>)", "2:24", "some results have chances, and others have none", "write success:0.7;failure:0.3"},
  {R"(<leaf path="*" result="success:0;failure:1"/>)", "2:24", "'0' is not a chance of success", "a chance is a number above 0, at most 1; leave out a result that never comes"},
  {R"(<leaf path="*" result="success:half"/>)", "2:24", "'half' is not a chance of success", "a chance is a number above 0, at most 1; leave out a result that never comes"},
  {R"(<leaf path="*" result="success:0.5;success:0.5"/>)", "2:24", "'success' has two chances", "write success:0.7;failure:0.3"},
  {R"(<fact name="day"/><leaf path="*" fact="day" result="success:0.5;failure:0.5"/>)", "2:25", "the result is a fact, so its chances have no effect", "give them to the fact: <fact name=\"…\" chance=\"0.7\"/>"},
  {R"(<fact name="day" starts="true"/>)", "2:26", "'starts' has no effect on a fact that changes freely", "add changes=\"never\": then only leaves that set it change it"},
  {R"(<fact name="day" starts="yes" changes="never"/>)", "2:26", "'starts' cannot be 'yes'", "it can be: 'true', 'false'"},
  {R"(<fact name="day" chance="1.5"/>)", "2:26", "'chance' must be a number between 0 and 1", ""},
  {R"(<fact name="day" chance="0.5" starts="true" changes="never"/>)", "2:26", "'chance' has no effect on a fact that is known from its start on", ""},
  {R"(<leaf path="*" sets_on_failure="day"/>)", "2:33", "'day' does not set a fact", "write charged=true, or charged=true;seen=false"},
};
// clang-format on

}  // namespace

TEST_CASE("a mistake in a leaf model is reported at its place") {
  for (const Mistake& it : kMistakes) {
    INFO(it.rows);
    Read read = test::read(it.rows, "Sequence(a)");
    read.diagnostics.sort();
    REQUIRE(read.diagnostics.has_errors());
    const Diagnostic& first = read.diagnostics.all().front();
    CHECK(std::to_string(first.location.line) + ':' + std::to_string(first.location.column) ==
          it.at);
    CHECK(first.message == it.message);
    if (!it.hint.empty()) CHECK(first.hint == it.hint);
  }
}

TEST_CASE("what begins with another element is no leaf model") {
  Diagnostics diagnostics;
  CHECK(read_leaf_file("t.xml", "<root lockstep=\"1\"/>", diagnostics) == nullptr);
  CHECK(diagnostics.has_errors());
}

TEST_CASE("later rows win, and say nothing of what they leave out") {
  const Read it =
      read(R"(<leaf of="Scripted" ticks="2..3" finish="full"/><leaf path="*" ticks="1..9"/>)",
           "Sequence(a)");
  const LeafModel& model = it.models.leaves.at(0);
  CHECK(model.least_ticks == 1);
  CHECK(model.most_ticks == 9);
  CHECK(model.finishes_full);
}

TEST_CASE("a star stands for any part of a path") {
  CHECK(matches("Main/arm", "Main/arm"));
  CHECK(matches("*/arm", "Main/pull/arm"));
  CHECK(matches("Main/*/arm", "Main/a/b/arm"));
  CHECK(matches("*", "Main"));
  CHECK_FALSE(matches("*/arm", "Main/arm2"));
  CHECK_FALSE(matches("Main/*/arm", "Main/arm"));
}

TEST_CASE("the cuts of a leaf are the barriers above it, as far as it goes until there") {
  using Levels = std::vector<double>;
  const auto levels = [](std::string_view tree) { return model_of("", tree).levels; };
  CHECK(levels("Sequence(a)") == Levels{0});
  CHECK(levels("ParallelAbsolute[barriers=.25;.5](a b)") == Levels{0, .25, .5});
  CHECK(levels("ParallelAbsolute[barriers=.25;.75](Sequence(a b) c)") == Levels{0, .5});
  CHECK(levels("ParallelAbsolute[barriers=.75](Repeat[times=2](a) c)") == Levels{0, .5});
  CHECK(levels("ParallelAbsolute[barriers=.5](Inverter(a) c)") == Levels{0, .5});
  CHECK(levels("ParallelAbsolute[barriers=.5 at_barrier=tick](a c)") == Levels{0, .5, .75});
  CHECK(levels("ParallelAbsolute[barriers=1](a c)") == Levels{0, 1});
}

TEST_CASE("below a delta progress goes in steps, of which the delta is a multiple") {
  CHECK(model_of("", "ParallelRelative[delta=.2](a b)").parts == 10);
  CHECK(model_of("", "ParallelRelative[delta=.05](a b)").parts == 20);
  CHECK(model_of("", "ParallelRelative[delta=0](a b)").parts == 10);
  CHECK(model_of("", "ParallelRelative[delta=.2](a b)").levels.back() == 1);  // and it still runs
  const Read wrong =
      read(R"(<leaf path="*" progress="grid:10"/>)", "ParallelRelative[delta=.05](a b)");
  REQUIRE(wrong.diagnostics.has_errors());
  CHECK(wrong.diagnostics.all().front().hint == "write progress=\"grid:20\"");
  CHECK(read(R"(<leaf path="*" progress="cuts"/>)", "ParallelRelative[delta=.2](a b)")
            .diagnostics.has_errors());
}

TEST_CASE("an empty leaf model is the most general leaf") {
  const LeafModel model = model_of("", "Sequence(a)");
  CHECK(model.results == ResultSet{});
  CHECK(model.least_ticks == 1);
  CHECK(model.most_ticks == 0);
  CHECK(model.ends);
  CHECK_FALSE(model.drifts());
  CHECK_FALSE(model.finishes_full);
  CHECK(model.writes == Writes::InAnyTick);
  CHECK(model_of(R"(writes="success")", "Sequence(a)").writes == Writes::OnSuccess);
}

TEST_CASE("scripts of leaves are read as they are written") {
  LeafScripts scripts;
  scripts.rate = 12.5;
  scripts.ticks = 7;
  scripts.leaves["M/p/arm"] = {{.progress = 0.1},
                               {.kind = LeafWord::Kind::Held, .progress = 0.05},
                               {.status = Status::Success, .written = {{"place", "a b|[1;2]=%"}}}};
  scripts.leaves["M/c"] = {
      {.status = Status::Failure}, {.status = Status::Skipped}, {.kind = LeafWord::Kind::Fault}};
  scripts.cuts = {
      {.tick = 3},
      {.tick = 9, .leaves = {{"M/an arm", AfterCut::Continues}, {"M/b", AfterCut::Failure}}}};
  const std::string text = to_text(scripts);
  INFO(text);
  const auto read = parse_leaf_scripts(text);
  REQUIRE(read);
  CHECK(read->rate == scripts.rate);
  CHECK(read->ticks == scripts.ticks);
  CHECK(read->cuts == scripts.cuts);
  CHECK(read->leaves == scripts.leaves);
  CHECK_FALSE(is_leaf_file(text));
  CHECK(is_leaf_file("\n <leaves/>"));
}

TEST_CASE("a mistake in a script has its line") {
  struct Row {
    std::string_view text, at, message;
  };
  constexpr Row kRows[] = {
      {"\nM/a = R0 Q", "2:10", "'Q' is not a word of a leaf"},
      {"M/a = R2", "1:7", "'R2' is not a word of a leaf"},
      {"M/a = S[x]", "1:7", "'S[x]' is not a word of a leaf"},
      {"M/a R", "1:1", "expected the path of a leaf, ' = ' and its words"},
      {"# x\nM/a = R0\nM/a = S", "3:1", "'M/a' is there twice"},
      {"@rats 3", "1:1", "unknown setting '@rats'"},
      {"@ticks 0", "1:1", "'@ticks' is a whole number"},
      {"@rate no", "1:1", "'@rate' is a number from 0.001 to 100000"},
      {"@cut 3\n@cut 2", "2:1",
       "'@cut' is the number of a tick, from 1 on, and not before the one above it"},
      {"@cut 3 restart M/a", "1:1",
       "behind the tick of '@cut' comes continue, failure or success, and a path"},
      {"@cut 3 continue", "1:1",
       "behind the tick of '@cut' comes continue, failure or success, and a path"},
      {"@cut 0", "1:1",
       "'@cut' is the number of a tick, from 1 on, and not before the one above it"},
  };
  for (const Row& row : kRows) {
    INFO(row.text);
    const auto read = parse_leaf_scripts(row.text);
    REQUIRE_FALSE(read);
    CHECK(read.error().message == row.message);
    CHECK(fmt::format("{}:{}", read.error().line, read.error().column) == row.at);
  }
}

}  // namespace lockstep::host::test
