// A second format of recordings, in one file: what a developer has to write, and that ring, printer
// and file work with it.
#include "record/live/line_format.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <iterator>

#include "record/live/packet_printer.h"
#include "record/write/recorder.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::TemporaryPath;
using test::WatchedRun;

// "3 @300 1:> 2:+ entries 1" is tick 3, at 300 ms, with two nodes that changed.
class Signs final : public LineFormat {
 public:
  std::string header(const RecordingHeader& header) const override {
    return "run of " + header.id + "\n";
  }
  std::string end(const RecordedEnd& end) const override { return end.result + "\n"; }
  void set_tick_end(std::string& text, const TickEnd& end) const override {
    text = fmt::format(" entries {}\n", end.entries.size());
  }
  std::size_t most_of_tick_end(std::size_t, std::size_t, std::size_t) const override { return 32; }

  char* put_lost(char* to, std::uint64_t ticks, std::uint64_t from) const override {
    return fmt::format_to(to, "lost {} from {}\n", ticks, from);
  }
  char* put_tick(char* to, std::uint64_t tick, Nanoseconds time) const override {
    return fmt::format_to(to, "{} @{}", tick, time.count() / 1'000'000);
  }
  Put put_nodes(std::span<char> room, std::span<const NodeChange> nodes, bool) const override {
    constexpr std::size_t kMost = 14;
    const std::size_t count = std::min(nodes.size(), room.size() / kMost);
    char* to = room.data();
    for (const NodeChange& it : nodes.first(count)) {
      to = fmt::format_to(to, " {}:{}", it.node, "->+x="[static_cast<int>(it.activity())]);
    }
    return {to, count};
  }
  std::string part_header(std::string_view header, std::uint64_t first_tick) const override {
    return fmt::format("from {} on, {}", first_tick, header);
  }
  std::string part_end(std::uint64_t ticks) const override {
    return fmt::format("goes on after {}\n", ticks);
  }
};

const Signs kSigns;

TEST_CASE("a recording may have another format, which is one class") {
  const TemporaryPath file;
  WatchedRun run("Sequence(a b)", "a=RS b=RRF");
  Recorder recorder(
      run.run.tree(),
      {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}, .format = kSigns});
  run.watch({&recorder});
  CHECK(file.text() ==
        "run of Test\n"
        "0 @0 0:> 1:> entries 0\n"
        "1 @100 1:+ 2:> entries 0\n"
        "2 @200 0:> 1:+ entries 0\n"
        "3 @300 0:x 2:x entries 0\n"
        "failure\n");
}

TEST_CASE("a format writes the nodes of a tick in as many parts as its room needs") {
  PacketRing ring(100'000);
  std::vector<NodeChange> nodes(1000);
  std::string expected = "lost 2 from 7\n9 @90";
  for (NodeIndex node = 0; node < nodes.size(); ++node) {
    nodes[node] = {.node = node, .state = static_cast<std::uint8_t>(Activity::Running)};
    expected += fmt::format(" {}:>", node);
  }
  expected += " entries 0\n";
  Packet packet{.head = {.lost = 2, .lost_from = 7, .tick = 9, .time = 90'000'000},
                .nodes = nodes,
                .text = " entries 0\n"};
  packet.head.is_tick = 1;
  REQUIRE(ring.push(packet));
  PacketPrinter printer(ring, kSigns);
  char room[PacketPrinter::kLeastRoom];
  std::string text;
  int parts = 0;
  for (auto part = printer.print(room); !part.empty(); part = printer.print(room)) {
    text += part;
    ++parts;
  }
  CHECK(text == expected);
  CHECK(parts > 10);
}

}  // namespace
}  // namespace lockstep::host
