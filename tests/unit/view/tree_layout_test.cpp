#include "show/view/tree_layout.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "run/shape_of.h"
#include "show/view/tree_browser.h"
#include "show/view/tree_view.h"
#include "support/tree_text.h"

namespace lockstep::host {
namespace {

using test::tree_from_text;

// A Sequence of `stages` stages, each a ParallelAbsolute of 12, of which `current` runs; in it the
// first `waiting` children wait.
struct Stages {
  static constexpr NodeIndex kChildren = 12;

  explicit Stages(std::size_t stages = 20) {
    std::string text = "Sequence[memory=true](";
    for (std::size_t stage = 0; stage < stages; ++stage) {
      text += "ParallelAbsolute[barriers=.5](a b c d e f g h i j k l) ";
    }
    tree = shape_of(tree_from_text(text + ")"));
    now.nodes.resize(tree.nodes.size());
  }

  static NodeIndex stage(NodeIndex number) { return 1 + number * (kChildren + 1); }
  void set(NodeIndex first, NodeIndex count, Activity activity) {
    for (NodeIndex node = first; node < first + count; ++node) now.nodes[node].activity = activity;
  }
  void run_stage(NodeIndex number, NodeIndex waiting = 0) {
    set(0, static_cast<NodeIndex>(now.nodes.size()), Activity::Idle);
    set(0, 1, Activity::Running);
    set(1, stage(number) - 1, Activity::Success);
    set(stage(number), kChildren + 1, Activity::Running);
    set(stage(number) + 1, waiting, Activity::Paused);
  }
  std::vector<NodeIndex> rows(std::size_t room, const Browsing& browsing = {}) const {
    return lay_out(tree, now, browsing, room).rows;
  }
  bool shows(const std::vector<NodeIndex>& rows, NodeIndex node) const {
    return std::binary_search(rows.begin(), rows.end(), node);
  }

  Shape tree;
  Snapshot now;
};

TEST_CASE("what runs has a row, whatever the size of the tree and of the terminal") {
  Stages it;
  for (const std::size_t room : {22, 30, 38}) {
    for (const NodeIndex stage : {0, 7, 19}) {
      it.run_stage(stage, 5);
      const auto rows = it.rows(room);
      CAPTURE(room, stage);
      CHECK(rows.size() == room - 1);
      CHECK(std::is_sorted(rows.begin(), rows.end()));
      CHECK(it.shows(rows, 0));
      for (NodeIndex node = 0; node <= Stages::kChildren; ++node) {
        CHECK(it.shows(rows, Stages::stage(stage) + node));
      }
      // The room that is left is for the stages next to it.
      if (stage > 0) CHECK(it.shows(rows, Stages::stage(stage - 1)));
      if (stage < 19) CHECK(it.shows(rows, Stages::stage(stage + 1)));
      CHECK(!it.shows(rows, Stages::stage(stage == 0 ? 19 : 0) + 1));
    }
  }
}

TEST_CASE("where not even that fits: what runs comes before what waits") {
  Stages it;
  it.run_stage(7, 10);
  const NodeIndex stage = Stages::stage(7);
  CHECK(it.rows(4) == std::vector<NodeIndex>{stage, stage + 11, stage + 12});
  CHECK(it.rows(6) == std::vector<NodeIndex>{stage, stage + 1, stage + 2, stage + 11, stage + 12});
  const Layout layout = lay_out(it.tree, it.now, {}, 4);
  CHECK(layout.left_out.text() == "1 running, 10 waiting, 91 succeeded, 156 idle");
  CHECK(layout.all == it.tree.nodes.size());
  CHECK(it.rows(1).empty());
  CHECK(it.rows(1000).size() == it.tree.nodes.size());
}

TEST_CASE("of a deep tree what runs, and what is nearest above it") {
  std::string text = "a";
  for (int depth = 0; depth < 30; ++depth) text = "Inverter(" + text + ")";
  const Shape tree = shape_of(tree_from_text(text));
  Snapshot now;
  now.nodes.resize(tree.nodes.size(), {.activity = Activity::Running});
  CHECK(lay_out(tree, now, {}, 5).rows == std::vector<NodeIndex>{27, 28, 29, 30});
  // It is not indented out of sight.
  const std::string drawn = draw(tree, now, {.width = 40, .height = 7});
  CHECK(drawn.find("\n> Inverter\n  > Inverter\n    > Inverter\n      > a (Scripted)\n") !=
        std::string::npos);
}

TEST_CASE("after a run that failed: what failed comes first") {
  Stages it;
  it.set(1, Stages::stage(12) - 1, Activity::Success);
  for (const NodeIndex node : {0u, Stages::stage(12), Stages::stage(12) + 4}) {
    it.now.nodes[node].activity = Activity::Failure;
  }
  CHECK(it.rows(4) == std::vector<NodeIndex>{0, Stages::stage(12), Stages::stage(12) + 4});
}

TEST_CASE("folded nodes are one row, and make room") {
  Stages it;
  it.run_stage(7);
  Browsing browsing;
  for (NodeIndex stage = 0; stage < 20; ++stage) {
    if (stage != 7) browsing.folded.insert(Stages::stage(stage));
  }
  CHECK(it.rows(33, browsing).size() == 1 + 20 + Stages::kChildren);
  CHECK(unfolded(it.tree, {0}) == std::vector<NodeIndex>{0});
  const std::string drawn =
      draw(it.tree, it.now, {.width = 100, .height = 40, .browsing = &browsing});
  CHECK(drawn.find("\n  + ParallelAbsolute  + 12 nodes: 12 succeeded\n") != std::string::npos);
  CHECK(drawn.find("\n  - ParallelAbsolute#20 (ParallelAbsolute)  + 12 nodes: 12 idle\n") !=
        std::string::npos);
  CHECK(drawn.find("left out") == std::string::npos);
}

TEST_CASE("around the cursor there is one part of the tree") {
  Stages it;
  const auto from_to = [&](NodeIndex cursor) {
    const auto rows = it.rows(11, {.folded = {}, .cursor = cursor});
    REQUIRE(rows.size() == 10);
    CHECK(rows.back() - rows.front() == 9);
    CHECK(it.shows(rows, cursor));
    return rows.front();
  };
  CHECK(from_to(0) == 0);
  CHECK(from_to(3) == 0);
  CHECK(from_to(100) == 95);
  CHECK(from_to(260) == 251);
}

Key key(KeyKind kind) {
  return {kind};
}

TEST_CASE("keys scroll, from what runs on, and back to following it") {
  Stages it;
  it.run_stage(7);
  TreeBrowser browser(it.tree);
  const auto cursor = [&](Key pressed) {
    CHECK(browser.press(pressed, it.now, 20));
    return browser.browsing().cursor.value_or(9999);
  };
  const NodeIndex first = Stages::stage(7) + 1;
  CHECK(cursor(key(KeyKind::Down)) == first);
  CHECK(cursor(key(KeyKind::Down)) == first + 1);
  CHECK(cursor(key(KeyKind::Up)) == first);
  CHECK(cursor(key(KeyKind::PageUp)) == first - 19);
  CHECK(cursor(key(KeyKind::PageDown)) == first);
  for (int page = 0; page < 30; ++page) cursor(key(KeyKind::PageUp));
  CHECK(browser.browsing().cursor == 0u);
  for (int page = 0; page < 30; ++page) cursor(key(KeyKind::PageDown));
  CHECK(browser.browsing().cursor == 260u);
  CHECK(cursor(key(KeyKind::Escape)) == 9999);
  CHECK(!browser.press(key(KeyKind::Left), it.now, 20));
  CHECK(!browser.press({KeyKind::Character, 'g'}, it.now, 20));
}

TEST_CASE("keys fold and unfold: the node at the cursor, of a leaf its parent") {
  Stages it;
  it.run_stage(0);
  TreeBrowser browser(it.tree);
  const auto press = [&](Key pressed) { CHECK(browser.press(pressed, it.now, 20)); };
  press({KeyKind::Character, 'f'});  // shows the cursor
  CHECK(browser.browsing().cursor == 2u);
  CHECK(browser.browsing().folded.empty());
  press({KeyKind::Character, 'f'});
  CHECK(browser.browsing().folded == std::set<NodeIndex>{1});
  CHECK(browser.browsing().cursor == 1u);
  press(key(KeyKind::Down));
  CHECK(browser.browsing().cursor == 14u);
  press({KeyKind::Character, 'f'});
  press(key(KeyKind::Up));
  CHECK(browser.browsing().cursor == 1u);
  press({KeyKind::Character, 'f'});
  CHECK(browser.browsing().folded == std::set<NodeIndex>{14});
  press({KeyKind::Character, 'F'});
  CHECK(browser.browsing().folded.empty());
  const Shape leaf = shape_of(tree_from_text("a"));
  Snapshot now;
  now.nodes.resize(1);
  TreeBrowser alone(leaf);
  CHECK(alone.press({KeyKind::Character, 'f'}, now, 20));
  CHECK(alone.press({KeyKind::Character, 'f'}, now, 20));
  CHECK(alone.browsing().folded.empty());
}

TEST_CASE("while there is a cursor a view says where it is, and which keys there are") {
  Stages it;
  it.run_stage(7);
  Browsing browsing{.folded = {}, .cursor = Stages::stage(7) + 2};
  const std::string drawn =
      draw(it.tree, it.now, {.width = 80, .height = 8, .keys = true, .browsing = &browsing});
  CHECK(drawn ==
        "Test  0 Hz  tick 0  0.000 s  overruns 0\n"
        "  > ParallelAbsolute#8 (ParallelAbsolute)\n"
        "    > a [..........|.........] 0.00\n"
        "*   > b [..........|.........] 0.00\n"
        "    > c [..........|.........] 0.00\n"
        "    > d [..........|.........] 0.00\n"
        "rows 93 to 97 of 261  up down scroll  f fold  F unfold all  esc follow\n");
}

}  // namespace
}  // namespace lockstep::host
