// The feed of snapshots: what it has of the blackboard and of logs, live and from a recording, and
// what a view draws of it below the tree.
#include "record/live/snapshot_feed.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <sstream>

#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "show/view/console_live.h"
#include "show/view/replay/replay_view.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::TemporaryPath;
using test::TextFile;
using test::WatchedRun;

std::vector<std::string> keys(const Shape& shape) {
  std::vector<std::string> keys;
  for (const ShapeEntry& it : shape.entries) keys.push_back(it.key);
  return keys;
}

// Each look at this clock is a second later, so that each tick is published.
Nanoseconds hurried() {
  static Nanoseconds now{0};
  return now += std::chrono::seconds(1);
}

// Two entries, 'pause' and 'plan', that leaves write in the given ticks; in each of these a leaf
// logs which tick it is.
struct Writes : Observer {
  explicit Writes(WatchedRun& run) : run_(run) {}
  void before_tick(const Moment&, std::uint64_t tick, Nanoseconds) override {
    for (auto [at, end] = values.equal_range(tick); at != end; ++at) {
      run_.run.set(at->second.first, at->second.second);
      log("Test/a", "info", "tick " + std::to_string(tick));
    }
  }
  std::multimap<std::uint64_t, std::pair<std::string, Value>> values;
  std::function<void(std::string_view, std::string_view, std::string_view)> log = [](auto, auto,
                                                                                     auto) {};

 private:
  WatchedRun& run_;
};

// No tick comes to the nodes that read them.
constexpr const char* kFeedTree =
    "Sequence(a Wait[seconds={pause}] ParallelAbsolute[barriers={plan}](b c))";
constexpr const char* kFeedLeaves = "a=R b=R c=R";

std::vector<double> list(std::initializer_list<double> numbers) {
  return numbers;
}

// What the feed has after each tick, and what a replay of the same run has.
struct Shown final : Observer {
  Shown(SnapshotFeed& feed, std::vector<Snapshot>& all) : feed_(feed), all_(all) {}
  void after_tick(const Moment&, const TickReport&) override {
    REQUIRE(feed_.take());
    all_.push_back(feed_.newest());
  }

 private:
  SnapshotFeed& feed_;
  std::vector<Snapshot>& all_;
};

TEST_CASE("a snapshot has the value of each entry, and the tick of its last change") {
  WatchedRun run(kFeedTree, kFeedLeaves);
  Writes writes(run);
  writes.values = {{1, {"plan", list({0.5, 1})}},
                   {2, {"plan", list({0.5, 1})}},  // the same value is no change
                   {3, {"pause", 7.5}},
                   {4, {"plan", std::vector<double>(200, 0.123456)}}};
  SnapshotFeed feed(shape_of(run.run.tree()), hurried);
  std::vector<Snapshot> all;
  Shown shown(feed, all);
  run.watch({&writes, &feed, &shown}, 6);
  REQUIRE(all.size() == 6);
  REQUIRE(keys(shape_of(run.run.tree())) == std::vector<std::string>{"pause", "plan"});
  CHECK(all[0].entries == std::vector<EntryState>(2));
  CHECK(all[1].entries[1] == EntryState{"0.5;1", false, 1});
  CHECK(all[2].entries[1] == EntryState{"0.5;1", false, 1});
  CHECK_FALSE(all[2].entries[0].changed);
  CHECK(all[3].entries[0] == EntryState{"7.5", false, 3});
  CHECK(all[4].entries[1] == EntryState{"", true, 4});
  CHECK(all[5].entries == all[4].entries);
}

TEST_CASE("a snapshot has the last lines that leaves logged, and counts the others") {
  WatchedRun run("Sequence(a)", "a=R");
  SnapshotFeed feed(shape_of(run.run.tree()), hurried);
  for (int i = 1; i <= 20; ++i) feed.log("Test/a", "info", "line " + std::to_string(i));
  std::vector<Snapshot> all;
  Shown shown(feed, all);
  run.watch({&feed, &shown}, 2);
  REQUIRE(all.size() == 2);
  const RecentLines& logs = all[0].logs;
  REQUIRE(logs.lines.size() == RecentLines::kMost);
  CHECK(logs.lines.front() == LeafLine{"Test/a", "info", "line 5"});
  CHECK(logs.lines.back() == LeafLine{"Test/a", "info", "line 20"});
  CHECK(logs.earlier == 4);
  CHECK(all[1].logs == logs);
}

TEST_CASE("the last snapshot has what leaves log when they are halted, and what had no room") {
  WatchedRun run("Sequence(a)", "a=R");
  SnapshotFeed feed(shape_of(run.run.tree()), hurried);
  run.watch({&feed}, 1);
  const std::string half(LeafLines::kRoom / 2, 'x');
  for (int i = 0; i < 4; ++i) feed.log("Test/a", "info", half);
  LiveMoments moments(run.run.tree());
  feed.run_ended(moments.now(run.run.ticker()), {});
  REQUIRE(feed.take());
  CHECK(feed.newest().logs.lines.size() == 1);
  CHECK(feed.newest().logs.earlier == 3);
}

TEST_CASE("a replay has the entries and logs of the live snapshots, forward and back") {
  const TemporaryPath file;
  WatchedRun run(kFeedTree, kFeedLeaves);
  Writes writes(run);
  for (std::uint64_t tick = 1; tick < 40; tick += 3) {
    writes.values.insert({tick, {"plan", list({0.01 * static_cast<double>(tick), 1})}});
    if (tick % 2 == 0) writes.values.insert({tick, {"pause", static_cast<double>(100 + tick)}});
  }
  writes.values.insert({20, {"plan", std::vector<double>(200, 0.123456)}});
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  SnapshotFeed feed(shape_of(run.run.tree()), hurried);
  writes.log = [&](auto who, auto level, auto text) {
    recorder.log(who, level, text);
    feed.log(who, level, text);
  };
  std::vector<Snapshot> live;
  Shown shown(feed, live);
  run.watch({&writes, &recorder, &feed, &shown}, 40);
  std::istringstream in(file.text());
  RecordingReader reader(in, "run.jsonl");
  const RecordingHeader& header = reader.header();
  CHECK(keys(header) == keys(shape_of(run.run.tree())));
  RecordingTimeline timeline(reader, {.distance = 300});
  REQUIRE(timeline.size() == live.size());
  CHECK(timeline.keyframes() > 3);
  CHECK(live.back().logs.earlier > 0);
  const auto check = [&] {
    const Snapshot replayed = snapshot_of(header, timeline.now(), nullptr);
    const Snapshot& expected = live[timeline.now().tick];
    CAPTURE(timeline.now().tick);
    CHECK(replayed.entries == expected.entries);
    CHECK(replayed.logs == expected.logs);
  };
  for (check(); !timeline.at_end(); check()) timeline.step_forward();
  for (; timeline.now().tick > 0; check()) timeline.step_back();
  timeline.go_to_tick(25);
  check();
}

// --- what is drawn -------------------------------------------------------------------------------

struct ShownBoard {
  // Each with its value and the tick of its last change.
  explicit ShownBoard(const std::vector<std::pair<std::string, EntryState>>& entries) {
    shape.nodes.push_back({.path = "Test/wait", .kind = "Wait", .name = "wait"});
    complete(shape);
    for (const auto& [key, state] : entries) {
      shape.entries.push_back({.key = key, .type = {}});
      snapshot.entries.push_back(state);
    }
  }
  std::string below(DrawOptions options = {.width = 40, .height = 24}) const {
    const std::string text = draw(shape, snapshot, options);
    const auto lines = std::count(text.begin(), text.end(), '\n');
    CHECK(lines < static_cast<std::ptrdiff_t>(std::max(options.height, 3u)));
    return text.substr(text.find('\n', text.find('\n') + 1) + 1);
  }
  Shape shape{.id = "Test"};
  Snapshot snapshot{.header = {}, .nodes = std::vector<NodeView>(1)};
};

EntryState at(std::uint64_t tick, const std::string& text) {
  return {.text = text, .changed = tick};
}

TEST_CASE("below the tree are the five entries that changed last, and how many more there are") {
  ShownBoard board({{"a", at(3, "1")}, {"b", at(9, "2")}, {"c", {}}, {"d", at(3, "4")}});
  CHECK(board.below() ==
        "b = 2  tick 9\n"
        "a = 1  tick 3\n"
        "d = 4  tick 3\n");
  board = ShownBoard({{"a", at(1, "1")},
                      {"b", at(2, "2")},
                      {"c", at(3, "3")},
                      {"d", at(4, "4")},
                      {"e", at(5, "5")},
                      {"f", at(6, "6")}});
  CHECK(board.below() ==
        "f = 6  tick 6\n"
        "e = 5  tick 5\n"
        "d = 4  tick 4\n"
        "c = 3  tick 3\n"
        "b = 2  tick 2\n"
        "... 1 more entry\n");
  CHECK(board.below({.width = 40, .height = 6}) ==
        "f = 6  tick 6\n"
        "e = 5  tick 5\n"
        "... 4 more entries\n");
  CHECK(board.below({.width = 40, .height = 4}).empty());
  CHECK(board.below({.width = 40, .height = 1}).empty());
  CHECK(ShownBoard({{"c", {}}, {"d", {}}}).below().empty());
}

TEST_CASE("a value fits into one line of the terminal, whatever it is") {
  const ShownBoard board({{"text", at(8, "two\nlines \x1b[2J")},
                          {"long", {.is_long = true, .changed = 7}},
                          {"list", at(6, "0.1;0.2;0.3;0.4;0.5")}});
  CHECK(board.below({.width = 24, .height = 24}) ==
        "text = two\\x0Alines \\...\n"
        "long = (too long to b...\n"
        "list = 0.1;0.2;0.3;0....\n");
  CHECK(ShownBoard({{"k", at(1, "v")}, {"none", {}}})
            .below({.width = 40, .height = 24, .color = true}) == "k = v\x1b[2m  tick 1\x1b[0m\n");
}

TEST_CASE("entries take no room from the nodes of the tree") {
  ShownBoard board({{"a", at(1, "1")}, {"b", at(2, "2")}});
  for (int i = 0; i < 3; ++i) {
    board.shape.nodes.push_back({.path = "Test/c", .kind = "Wait", .name = "c"});
    board.snapshot.nodes.emplace_back();
  }
  const auto drawn = [&](unsigned height) {
    return draw(board.shape, board.snapshot, {.width = 40, .height = height});
  };
  CHECK(drawn(6).find(" = ") == std::string::npos);
  CHECK(drawn(8).ends_with("b = 2  tick 2\na = 1  tick 1\n"));
  CHECK(drawn(5).find("left out") != std::string::npos);
  CHECK(drawn(5).find(" = ") == std::string::npos);
}

TEST_CASE("logs are drawn below the entries where they are asked for") {
  ShownBoard board({{"a", at(1, "1")}});
  for (const char* text : {"one", "two", "three"}) {
    board.snapshot.logs.add({"Test/a", "info", text});
  }
  CHECK(board.below() == "a = 1  tick 1\n");
  CHECK(board.below({.width = 40, .height = 24, .logs = 2}) ==
        "a = 1  tick 1\n"
        "Test/a: info: two\n"
        "Test/a: info: three\n");
  CHECK(board.below({.width = 40, .height = 5, .logs = 2}) ==
        "a = 1  tick 1\n"
        "Test/a: info: three\n");
}

TEST_CASE("the live view shows entries below the tree") {
  TextFile out;
  WatchedRun run(kFeedTree, kFeedLeaves);
  Writes writes(run);
  writes.values = {{2, {"plan", list({0.5, 1})}}};
  ConsoleLive live(shape_of(run.run.tree()), {.color = false, .unicode = false}, out.outlet());
  run.watch({&writes, &live}, 4);
  const std::string text = out.text();
  CHECK(text.find("plan = 0.5;1  tick 2\x1b[K\n\x1b[J\x1b[?25h") != std::string::npos);
}

}  // namespace
}  // namespace lockstep::host
