// The feed of the monitor: what a listener knows after its lines is what a recording has of those
// ticks.
#include "record/live/line_feed.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include "dialect/btcpp/rules.h"
#include "record/json_lines.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "support/json.h"
#include "support/text.h"
#include "support/tree_text.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using nlohmann::json;
using test::contains;
using test::TemporaryPath;
using test::WatchedRun;

Nanoseconds g_now{0};
Nanoseconds now_of_test() {
  return g_now;
}

// What a reader of lines knows: of each node and entry what was said last.
struct Known {
  std::map<int, json> nodes, limits, rounds, entries;

  void take(const json& line) {
    if (line.value("full", false)) *this = {};
    for (const json& node : line["nodes"]) nodes[node[0]] = node;
    for (const json& node : line.value("limits", json::array())) limits[node[0]] = node;
    for (const json& node : line.value("rounds", json::array())) rounds[node[0]] = node;
    for (const json& entry : line.value("entries", json::array())) entries[entry[0]] = entry;
    forget_idle();
    std::erase_if(limits, [](const auto& it) { return it.second[1] == 0; });
    std::erase_if(rounds, [](const auto& it) { return it.second[1] == 0; });
  }
  void forget_idle() {
    std::erase_if(nodes, [](const auto& it) {
      return it.second == json{it.first, "idle", 0, 0, 0};
    });
  }
  // What the feed does not follow: the limit of a node that the tick did not reach.
  void forget_limits() {
    std::erase_if(limits, [&](const auto& it) {
      const auto node = nodes.find(it.first);
      return node == nodes.end() || node->second[3] == 0;
    });
  }
  bool operator==(const Known&) const = default;
};

// After the line of each tick.
std::map<int, Known> known_after(const std::string& lines) {
  std::map<int, Known> all;
  Known known;
  std::istringstream in(lines);
  for (std::string text; std::getline(in, text);) {
    const json line = test::parse_json(text);
    if (!line.contains("tick")) continue;
    known.take(line);
    Known& after = all[line["tick"]] = known;
    after.forget_limits();
  }
  return all;
}

std::string text_of(const Known& known) {
  return json{known.nodes, known.limits, known.rounds, known.entries}.dump();
}

Known without_progress(Known known) {
  for (auto& [node, state] : known.nodes) state[2] = 0;
  known.forget_idle();
  return known;
}

// Takes 7 ms for each tick, takes the lines out now and then, and wants a full one at times.
struct Reader final : Observer {
  explicit Reader(LineFeed& it) : feed(it) {}
  void after_tick(const Moment&, const TickReport& report) override {
    g_now += std::chrono::milliseconds(7);
    if (report.tick % 3 == 0) feed.take(lines);
    if (report.tick % 41 == 0) feed.want_full();
  }
  LineFeed& feed;
  std::string lines;
};

struct Watched {
  std::map<int, Known> seen, recorded;
  std::string lines;
};

Watched watch(WatchedRun& run) {
  const TemporaryPath file;
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  g_now = std::chrono::seconds(1);
  LineFeed feed(shape_of(run.run.tree()), {.tree_file = "a.xml", .rate_hz = 10}, now_of_test);
  Reader reader(feed);
  run.watch({&recorder, &feed, &reader}, 300);
  feed.take(reader.lines);
  return {known_after(reader.lines), known_after(file.text()), reader.lines};
}

TEST_CASE("a listener of the monitor knows what the recording has of the same tick") {
  WatchedRun run(
      "Repeat[times=12](Sequence(x Fallback(g ParallelAbsolute[barriers=.25;.5;.75](a b)) y))",
      "x=RS g=F a+.125 b+.25 y=RS...");
  const auto [seen, recorded, lines] = watch(run);
  REQUIRE(recorded.size() > 20);
  for (const auto& [tick, known] : seen) {
    CAPTURE(tick);
    CHECK(text_of(without_progress(known)) == text_of(without_progress(recorded.at(tick))));
    // What is kept in step: also the progress.
    for (const int child : {6, 7}) {
      if (!known.nodes.contains(5) || known.nodes.at(5)[3] == 0) continue;
      CHECK(known.nodes.contains(child) == recorded.at(tick).nodes.contains(child));
      if (known.nodes.contains(child)) {
        CHECK(known.nodes.at(child) == recorded.at(tick).nodes.at(child));
      }
    }
  }
  CHECK(seen.rbegin()->first == recorded.rbegin()->first);  // the last tick, whenever it came
  CHECK(contains(lines, ",\"full\":true}\n"));
}

TEST_CASE("each tick in which something happens has a line, of others one of 50 ms") {
  WatchedRun run(
      "Repeat[times=12](Sequence(x Fallback(g ParallelAbsolute[barriers=.25;.5;.75](a b)) y))",
      "x=RS g=F a+.125 b+.25 y=RS...");
  const auto [seen, recorded, lines] = watch(run);
  Known before;
  for (const auto& [tick, known] : recorded) {
    CAPTURE(tick);
    Known now = without_progress(known);
    if (now != before) CHECK(seen.contains(tick));
    before = std::move(now);
  }
  WatchedRun quiet("Sequence(a)", "a+.003");
  const Watched sampled = watch(quiet);
  CHECK(sampled.recorded.size() == 300);
  CHECK(sampled.seen.size() > 300 / 10);
  CHECK(sampled.seen.size() < 300 / 5);  // 7 of 50 ms
}

TEST_CASE("a line with the whole state has what the run has had until then") {
  WatchedRun run("Repeat[times=30](ForceSuccess(Sequence(a b)))", "a=RS b=F");
  const Watched watched = watch(run);
  std::istringstream in(watched.lines);
  int full = 0;
  for (std::string text; std::getline(in, text);) {
    const json line = test::parse_json(text);
    if (!line.value("full", false)) continue;
    ++full;
    std::map<int, json> counts;
    for (const json& count : line.at("counts")) counts[count[0]] = count;
    const int failures = (line["tick"].get<int>() + 1) / 2;
    CAPTURE(line["tick"]);
    if (failures == 0) continue;
    CHECK(counts.at(3) == json{3, failures, 0, 0, 0, 0, 0});
    CHECK(counts.at(4) == json{4, 0, failures, 0, 0, 0, 0});
  }
  CHECK(full > 1);
}

TEST_CASE("a node that fails in each tick has failed as often as there were ticks") {
  WatchedRun run("Retry[attempts=100](a)", "a=F");
  const Watched watched = watch(run);
  const std::size_t last = watched.lines.rfind("\"counts\"");
  REQUIRE(last != std::string::npos);
  const std::size_t begin = watched.lines.rfind('\n', last) + 1;
  const json line =
      test::parse_json(watched.lines.substr(begin, watched.lines.find('\n', begin) - begin));
  const int tick = line["tick"];
  CHECK(tick > 50);
  CHECK(line["counts"][0] == json{1, 0, tick + 1, 0, 0, 0, 0});
}

// Each listener that comes while the run stands gets the whole state, which is that of the last
// tick.
TEST_CASE("a run that stands has had no more, however often the whole state is asked for") {
  WatchedRun run(
      test::tree_from_text("KeepRunningUntilFailure(Repeat[num_cycles=3](a))", btcpp::kRules),
      "a=S");
  g_now = std::chrono::seconds(1);
  LineFeed feed(shape_of(run.run.tree()), {.tree_file = "a.xml", .rate_hz = 10}, now_of_test);
  struct Listeners final : Observer {
    explicit Listeners(LineFeed& it) : feed(it) {}
    void after_tick(const Moment& moment, const TickReport&) override {
      for (int i = 0; i < 3; ++i) {
        feed.want_full();
        feed.standing(moment);
        std::string lines;
        feed.take(lines);
        counts.push_back(test::parse_json(lines.substr(lines.rfind("{\"tick\""))).at("counts"));
      }
    }
    LineFeed& feed;
    std::vector<json> counts;
  } listeners(feed);
  run.watch({&feed, &listeners}, 4);
  REQUIRE(listeners.counts.size() == 12);
  for (std::size_t i = 0; i < listeners.counts.size(); ++i) {
    CAPTURE(i);
    CHECK(listeners.counts[i].back() == json{2, 3 * (i / 3 + 1), 0, 0, 0, 0, 0});
  }
}

TEST_CASE("lines that find no room are counted, and the next one has what they had") {
  WatchedRun run("Sequence(a)", "a=R");
  g_now = std::chrono::seconds(1);
  LineFeed feed(shape_of(run.run.tree()), {.tree_file = "a.xml"}, now_of_test);
  const std::string long_text(LeafLines::kRoom / 2, 'x');
  struct Chatter final : Observer {
    void before_tick(const Moment&, std::uint64_t tick, Nanoseconds) override {
      g_now += std::chrono::milliseconds(50);
      feed.log("Test/a", "info", std::to_string(tick) + text);
    }
    Chatter(LineFeed& it, const std::string& said) : feed(it), text(said) {}
    LineFeed& feed;
    const std::string& text;
  } chatter(feed, long_text);
  struct LateTaker final : Observer {
    void after_tick(const Moment&, const TickReport& report) override {
      if (report.tick == 98) feed.take(lines);
    }
    explicit LateTaker(LineFeed& it) : feed(it) {}
    LineFeed& feed;
    std::string lines;
  } taker(feed);
  run.watch({&chatter, &feed, &taker}, 100);
  CHECK(taker.lines.size() < std::size_t{3} << 20);
  CHECK(contains(taker.lines, "\"0xxx"));
  const auto kept = static_cast<int>(known_after(taker.lines).size());
  std::string after;
  feed.take(after);
  const int lost = 99 - kept;
  INFO(after.substr(0, 100));
  CHECK(after.starts_with("{\"lost\":{\"ticks\":" + std::to_string(lost) +
                          ",\"from\":" + std::to_string(kept) + "}}\n{\"tick\":99,"));
}

// On a virtual clock nothing can be late.
TEST_CASE("on a virtual clock a tick waits for the one who takes lines, and none is lost") {
  WatchedRun run("Sequence(a)", "a=R");
  g_now = std::chrono::seconds(1);
  LineFeed feed(shape_of(run.run.tree()), {.tree_file = "a.xml"}, now_of_test);
  struct Chatter final : Observer {
    void before_tick(const Moment&, std::uint64_t, Nanoseconds) override {
      feed.log("a", "info", text);
    }
    explicit Chatter(LineFeed& it) : feed(it), text(LeafLines::kRoom / 2, 'x') {}
    LineFeed& feed;
    const std::string text;
  } chatter(feed);
  Bell bell;
  std::atomic<bool> is_over{false};
  std::string lines;
  feed.begin_taking([&] { bell.ring(); });
  std::thread taker([&] {
    while (!is_over) {
      bell.wait(bell.rung(), std::chrono::milliseconds(1));
      feed.take(lines);
    }
  });
  run.watch({&chatter, &feed}, 300);
  is_over = true;
  taker.join();
  feed.take(lines);
  CHECK(known_after(lines).size() == 300);
  CHECK_FALSE(contains(lines, "\"lost\""));
  // Nobody takes any more: it does not wait for ever.
  feed.end_taking();
}

}  // namespace
}  // namespace lockstep::host
