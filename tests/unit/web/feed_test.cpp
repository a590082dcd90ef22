// The feed of the monitor: what a listener knows after its lines is what a recording has of those
// ticks.
#include "web/feed.h"

#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "recording/write/recorder.h"
#include "unit/recording/watched_run.h"

namespace lockstep {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

using nlohmann::json;
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
    std::erase_if(nodes, [](const auto& it) {
      return it.second == json{it.first, "idle", 0, 0, 0};
    });
    std::erase_if(limits, [](const auto& it) { return it.second[1] == 0; });
    std::erase_if(rounds, [](const auto& it) { return it.second[1] == 0; });
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

std::map<int, Known> known_after(const std::string& lines) {
  std::map<int, Known> all;
  Known known;
  std::istringstream in(lines);
  for (std::string text; std::getline(in, text);) {
    const json line = json::parse(text);
    if (!line.contains("tick")) continue;
    known.take(line);
    Known& after = all[line["tick"]] = known;
    after.forget_limits();
  }
  return all;
}

// Takes 7 ms for each tick, takes the lines out now and then, and wants a full one at times.
struct Reader final : Observer {
  explicit Reader(MonitorFeed& it) : feed(it) {}
  void after_tick(Ticker&, const TickReport& report) override {
    g_now += std::chrono::milliseconds(7);
    if (report.tick % 3 == 0) feed.take(lines);
    if (report.tick % 41 == 0) feed.want_full();
  }
  MonitorFeed& feed;
  std::string lines;
};

TEST_CASE("a listener of the monitor knows what the recording has of the same tick") {
  const TemporaryPath file;
  WatchedRun run(
      "Repeat[times=12](Sequence(x Fallback(g ParallelAbsolute[barriers=.25;.5;.75](a b)) y))",
      "x=RS g=F a+.125 b+.25 y=RS...");
  Recorder recorder(run.run.tree(),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  g_now = std::chrono::seconds(1);
  MonitorFeed feed(run.run.tree(), {.tree_file = "a.xml", .rate_hz = 10}, now_of_test);
  Reader reader(feed);
  run.watch({&recorder, &feed, &reader}, 300);
  feed.take(reader.lines);
  const auto seen = known_after(reader.lines);
  const auto recorded = known_after(file.text());
  REQUIRE(recorded.size() > 20);
  CHECK(seen.size() > recorded.size() / 10);
  CHECK(seen.size() < recorded.size() / 5);  // 7 of 50 ms
  for (const auto& [tick, known] : seen) {
    CAPTURE(tick);
    CHECK(known == recorded.at(tick));
  }
  CHECK(seen.rbegin()->first == recorded.rbegin()->first);  // the last tick, whenever it came
  CHECK(contains(reader.lines, ",\"full\":true}\n"));
}

TEST_CASE("lines that find no room are left out, and the next one has what they had") {
  WatchedRun run("Sequence(a)", "a=R");
  g_now = std::chrono::seconds(1);
  MonitorFeed feed(run.run.tree(), {.tree_file = "a.xml"}, now_of_test);
  const std::string long_text(LeafLines::kRoom / 2, 'x');
  struct Chatter final : Observer {
    void before_tick(Ticker&, std::uint64_t tick, Nanoseconds) override {
      g_now += std::chrono::milliseconds(50);
      feed.log("Test/a", "info", std::to_string(tick) + text);
    }
    Chatter(MonitorFeed& it, const std::string& said) : feed(it), text(said) {}
    MonitorFeed& feed;
    const std::string& text;
  } chatter(feed, long_text);
  run.watch({&chatter, &feed}, 100);
  std::string lines;
  feed.take(lines);
  CHECK(lines.size() < std::size_t{2} << 20);
  CHECK(contains(lines, "\"0xxx"));
  CHECK_FALSE(contains(lines, "\"tick\":99,"));
}

}  // namespace
}  // namespace lockstep
