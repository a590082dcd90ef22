#include "show/view/tree_view.h"
#include "run/shape_of.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "base/core/utf8.h"
#include "base/terminal/text_line.h"
#include "support/tree_text.h"

namespace lockstep::host {
namespace {

using test::tree_from_text;

std::string draw(const Tree& tree, const Snapshot& now, const DrawOptions& options) {
  return lockstep::host::draw(shape_of(tree), now, options);
}

Snapshot snapshot(std::vector<NodeView> nodes) {
  return {.header = {.rate_hz = 10, .tick = 4, .time = std::chrono::milliseconds(400)},
          .nodes = std::move(nodes)};
}

// A synchronized node, and the limit that counts.
NodeView limited(double limit, Activity activity = Activity::Running, double progress = 0) {
  return {.activity = activity, .progress = progress, .limit = limit};
}

constexpr DrawOptions kPlain{.width = 72, .height = 24};

TEST_CASE("the view of a run that continues after a cut tells how long that was") {
  const Tree tree = tree_from_text("a");
  Snapshot now = snapshot({{Activity::Running, 0.4}});
  now.header.resumed_after = std::chrono::seconds(35);
  CHECK(draw(tree, now, kPlain)
            .starts_with("Test  10 Hz  tick 4  0.400 s  overruns 0  resumed after 35 s\n"));
}

TEST_CASE("an absolute node: its barriers are marks in the bars") {
  const Tree tree = tree_from_text("ParallelAbsolute[barriers=.5;1](arm base)");
  const Snapshot now = snapshot({limited(0.5), {Activity::Paused, 0.6}, {Activity::Running, 0.4}});
  CHECK(draw(tree, now, kPlain) ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> ParallelAbsolute\n"
        "  = arm  [#########|........] 0.60  waits for base at barrier 0.5\n"
        "  > base [#######..|........] 0.40\n");
}

TEST_CASE("a pool: who owns what, and who waits for whom") {
  const Tree tree = tree_from_text(
      "Parallel(UseResources[pool=p resources=left](a) UseResources[pool=p "
      "resources=left;right](b)) "
      "resources[name=p]");
  const Snapshot now = snapshot({{Activity::Running},
                                 limited(1),
                                 {Activity::Running, 0.5},
                                 limited(-3),
                                 {Activity::Idle},
                                 {Activity::Running}});
  CHECK(draw(tree, now, kPlain) ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> Parallel\n"
        "  > UseResources\n"
        "    > a [#########.........] 0.50  owns left\n"
        "  > UseResources#2 (UseResources)\n"
        "    - b [..................] 0.00  waits for left (a)\n"
        "> p (resources)\n");
}

TEST_CASE("a relative node: the band in which its children may move") {
  const Tree tree = tree_from_text("ParallelRelative[delta=.25](arm base)");
  const Snapshot now = snapshot({limited(0.25), {Activity::Running, 0.5}, {Activity::Paused, 0.8}});
  CHECK(draw(tree, now, {.width = 80, .height = 24}) ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> ParallelRelative\n"
        "  > arm  [##########=====|....] 0.50\n"
        "  = base [###############|....] 0.80  waits for arm, 0.30 ahead (delta 0.25)\n");
}

TEST_CASE("a child that was skipped is not the one that the others wait for") {
  const Tree tree = tree_from_text("ParallelRelative[delta=.25](arm base gripper)");
  const Snapshot now = snapshot(
      {limited(0.25), {Activity::Running, 0.5}, {Activity::Paused, 0.8}, {Activity::Skipped}});
  CHECK(draw(tree, now, {.width = 80, .height = 24}) ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> ParallelRelative\n"
        "  > arm     [##########=====|....] 0.50\n"
        "  = base    [###############|....] 0.80  waits for arm, 0.30 ahead (delta 0.25)\n"
        "  ~ gripper [..........=====|....] 0.00\n");
}

TEST_CASE("a view with signs that need Unicode") {
  const Tree tree = tree_from_text("ParallelAbsolute[barriers=.5](a b)");
  const Snapshot now =
      snapshot({{Activity::Running}, {Activity::Success, 1}, {Activity::Failure, 0.25}});
  CHECK(draw(tree, now, {.width = 32, .height = 24, .unicode = true}) ==
        "Test  10 Hz  tick 4  0.400 s  o…\n"
        "▶ ParallelAbsolute\n"
        "  ✓ a [████┃███] 1.00\n"
        "  ✗ b [██░░┃░░░] 0.25\n");
}

TEST_CASE("colors come in pairs and do not count as columns") {
  const Tree tree = tree_from_text("Sequence(a)");
  const Snapshot now = snapshot({{Activity::Running}, {Activity::Success}});
  const std::string text = draw(tree, now, {.width = 12, .height = 24, .color = true});
  CHECK(text ==
        "\x1b[1mTest\x1b[0m  10 ...\n"
        "\x1b[36m>\x1b[0m Sequence\n"
        "  \x1b[32m+\x1b[0m a\x1b[2m (Sc...\x1b[0m\n");
}

TEST_CASE("only the topmost node that is held says for whom it waits") {
  const Tree tree =
      tree_from_text("ParallelRelative[delta=.1](a ParallelAbsolute[barriers=.5](b c))");
  const Snapshot now = snapshot({limited(0.1),
                                 {Activity::Running, 0.1},
                                 limited(0.5, Activity::Paused, 0.4),
                                 {Activity::Paused, 0.6},
                                 {Activity::Paused, 0.4}});
  CHECK(draw(tree, now, {.width = 90, .height = 24}) ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> ParallelRelative\n"
        "  > a                [##==|.................] 0.10\n"
        "  = ParallelAbsolute [####|###..............] 0.40  waits for a, 0.30 ahead (delta 0.1)\n"
        "    = b [###########|#.........] 0.60\n"
        "    = c [########...|..........] 0.40\n");
}

TEST_CASE("how the run ended stands in the first line") {
  const Tree tree = tree_from_text("Sequence(a)");
  Snapshot now = snapshot({{Activity::Success}, {Activity::Success}});
  now.header.real_time = false;
  now.header.result = RunResult::Success;
  CHECK(draw(tree, now, kPlain).starts_with("Test  10 Hz (virtual)  tick 4  0.400 s  success\n"));
  now.header.result = RunResult::Stopped;
  CHECK(draw(tree, now, kPlain).starts_with("Test  10 Hz (virtual)  tick 4  0.400 s  stopped\n"));
  now.header.result = RunResult::Fault;
  CHECK(draw(tree, now, kPlain).starts_with("Test  10 Hz (virtual)  tick 4  0.400 s  fault\n"));
}

TEST_CASE("what does not fit is counted, and what runs stays") {
  const Tree tree = tree_from_text("Sequence(a b c d ParallelRelative[delta=1](e f) g h)");
  std::vector<NodeView> nodes(tree.nodes.size());
  for (const std::size_t running : {0, 5, 6, 7, 9}) nodes[running].activity = Activity::Running;
  nodes[1].activity = Activity::Success;
  nodes[5].limit = 1;
  const std::string text = draw(tree, snapshot(nodes), {.width = 45, .height = 9, .keys = true});
  CHECK(text ==
        "Test  10 Hz  tick 4  0.400 s  overruns 0\n"
        "> Sequence\n"
        "  - d (Scripted)\n"
        "  > ParallelRelative\n"
        "    > e [===========] 0.00\n"
        "    > f [===========] 0.00\n"
        "  > h (Scripted)\n"
        "... 4 nodes left out: 1 succeeded, 3 idle ...\n");
}

TEST_CASE("a view never has more lines or columns than the terminal") {
  const Tree tree = tree_from_text(
      "Sequence(a b ParallelRelative[delta=.1](e ParallelAbsolute[barriers=.5](x y z)) g)");
  const Snapshot now = snapshot(std::vector<NodeView>(tree.nodes.size(), {Activity::Paused, 0.7}));
  for (unsigned height = 3; height < 16; ++height) {
    for (unsigned width = 1; width < 100; width += 7) {
      std::istringstream text(draw(tree, now, {.width = width, .height = height, .unicode = true}));
      unsigned lines = 0;
      for (std::string line; std::getline(text, line); ++lines) CHECK(columns(line) <= width);
      CHECK(lines <= height - 1);
    }
  }
}

TEST_CASE("names cannot send control sequences to the terminal") {
  Tree tree = tree_from_text("Sequence(a)");
  tree.labels[1].name = "a\x1b[2J";
  const std::string text = draw(tree, snapshot({{}, {}}), kPlain);
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(text.find("a\\x1B[2J") != std::string::npos);
}

TEST_CASE("a line that is cut ends in an ellipsis, one that just fits does not") {
  const auto text = [](std::size_t width, bool unicode, std::string_view rest = "") {
    TextLine line(width, false, unicode);
    line.add("barrier");
    line.add(rest);
    return line.text();
  };
  CHECK(text(7, true) == "barrier");
  CHECK(text(7, false) == "barrier");
  CHECK(text(6, true) == "barri…");
  CHECK(text(7, true, "s") == "barrie…");
  CHECK(text(6, false) == "bar...");
  CHECK(text(7, false, "s") == "barr...");
  CHECK(text(2, false) == "..");
  CHECK(text(1, true) == "…");
  CHECK(text(0, true) == "");
  TextLine styled(5, true, true);
  styled.add("ab", Style::Good);
  styled.add("cdef", Style::Bad);
  styled.add("gh");
  CHECK(styled.text() == "\x1b[32mab\x1b[0m\x1b[31mcd…\x1b[0m");
}

TEST_CASE("wide and foreign characters") {
  TextLine line(6, false, true);
  line.add("抓取抓");
  CHECK(line.text() == "抓取抓");
  line.add("取");
  CHECK(line.text() == "抓取…");
  TextLine ascii(6, false, false);
  ascii.add("Tür");
  CHECK(ascii.text() == "T?r");
  TextLine marked(3, false, true);
  marked.add("nai\u0308ve");
  CHECK(marked.text() == "na…");
  TextLine fits(5, false, true);
  fits.add("nai\u0308ve");
  CHECK(fits.text() == "nai\u0308ve");
}

TEST_CASE("a line is not much longer than its columns, whatever marks a name has") {
  std::string name = "a";
  for (int mark = 0; mark < 100'000; ++mark) name += "\u0301";
  TextLine line(20, false, true);
  line.add(name + "b");
  CHECK(line.column() == 2);
  CHECK(line.text().size() < 20);
}

}  // namespace
}  // namespace lockstep::host
