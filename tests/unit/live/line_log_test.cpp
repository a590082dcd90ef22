// The last lines of a run: where listeners begin, how they catch up, what is dropped.
#include "record/live/line_log.h"

#include <fmt/format.h>
#include <array>
#include <catch2/catch.hpp>

#include "record/json_lines.h"
#include "show/web/server_sent.h"
#include "support/text.h"

namespace lockstep::host {
namespace {

using test::contains;

std::string line(int tick, bool is_full = false, std::size_t length = 0) {
  return fmt::format("{{\"tick\":{},\"nodes\":[{}]{}}}\n", tick, std::string(length, '1'),
                     is_full ? ",\"full\":true" : "");
}

std::string event(int tick, bool is_full = false, std::size_t length = 0) {
  return fmt::format("id: {}\ndata: {}\n", tick, line(tick, is_full, length));
}

std::string read_all(LineLog& log, LineLog::Cursor& place, std::size_t piece = 7) {
  std::string all, room(piece, '\0');
  for (;;) {
    const std::size_t count = log.read(place, room);
    if (count == 0) return all;
    all.append(room, 0, count);
  }
}

TEST_CASE("a new listener begins at the last line that has the whole state") {
  LineLog log;
  CHECK(log.wants_full());
  log.set_header(sent_line("{\"lockstep_recording\":1}\n"));
  CHECK(log.header() == "data: {\"lockstep_recording\":1}\n\n");
  CHECK(log.header_line() == "{\"lockstep_recording\":1}\n");
  log.add(sent_line(line(0, true)));
  log.add(sent_line(line(1)));
  CHECK_FALSE(log.wants_full());
  log.add_state(sent_event("state", "{\"state\":\"running\"}"));
  log.add(sent_line(line(2, true)));
  log.add(sent_line(line(3)));
  auto place = log.begin(std::nullopt);
  CHECK(read_all(log, place) ==
        event(2, true) + "event: state\ndata: {\"state\":\"running\"}\n\n" + event(3));
  log.add(sent_line(line(4)));
  CHECK(read_all(log, place) == event(4));
  auto after = log.begin(1);
  CHECK(contains(read_all(log, after), event(3)));
  auto unknown = log.begin(77);
  CHECK(read_all(log, unknown).starts_with(event(2, true)));
}

TEST_CASE("a listener that falls behind goes on at a line that has the whole state") {
  LineLog log;
  log.add(sent_line(line(0, true, 10'000)));
  auto place = log.begin(std::nullopt);
  std::array<char, 10> some{};
  REQUIRE(log.read(place, some) == 10u);
  constexpr std::size_t kLong = LineLog::kMostBehind / 8;
  for (int tick = 1; tick < 11; ++tick) log.add(sent_line(line(tick, false, kLong)));
  // It has the rest of what it has begun, and asks for one.
  std::string rest(event(0, true, 10'000).size() - 10, '\0');
  REQUIRE(log.read(place, rest) == rest.size());
  CHECK(std::string(some.data(), 10) + rest == event(0, true, 10'000));
  CHECK_FALSE(log.wants_full());
  std::array<char, 1> byte{};
  REQUIRE(log.read(place, byte) == 1u);
  CHECK(log.wants_full());
  log.add(sent_line(line(11, true)));
  CHECK_FALSE(log.wants_full());
  log.add(sent_line(line(12)));
  CHECK(read_all(log, place) == event(1, false, kLong).substr(1) + event(11, true) + event(12));
}

TEST_CASE("a listener that is a little behind at the end goes on at the last whole state") {
  constexpr std::size_t kLong = LineLog::kMostAtEnd / 8;
  LineLog log;
  log.add(sent_line(line(0, true)));
  auto slow = log.begin(std::nullopt);
  for (int tick = 1; tick < 20; ++tick) log.add(sent_line(line(tick, false, kLong)));
  auto quick = log.begin(18);
  log.add(sent_line(line(19, true)));
  log.add(sent_line("{\"end\":{}}\n"));
  log.close();
  CHECK(read_all(log, slow) == event(19, true) + "data: {\"end\":{}}\n\n");
  CHECK(read_all(log, quick).starts_with(event(19, false, kLong)));
}

TEST_CASE("a listener that is a thousand lines behind misses none of them") {
  LineLog log;
  log.add(sent_line(line(0, true)));
  auto place = log.begin(std::nullopt);
  std::string wanted = event(0, true);
  for (int tick = 1; tick < 1000; ++tick) {
    log.add(sent_line(line(tick, tick % 100 == 0)));
    wanted += event(tick, tick % 100 == 0);
  }
  CHECK(read_all(log, place, 4096) == wanted);
}

TEST_CASE("the log has bounded size and begins with a line that has the whole state") {
  constexpr std::size_t kLong = 100'000;
  LineLog log;
  log.add(sent_line(line(0, true)));
  auto place = log.begin(std::nullopt);
  auto half = place;
  std::array<char, 10> some{};
  REQUIRE(log.read(half, some) == 10u);
  for (int tick = 1; tick < 1000; ++tick) {
    log.add(sent_line(line(tick, log.wants_full(), kLong)));
  }
  std::size_t bytes = 0;
  for (auto at = log.first(); at < log.end(); ++at) bytes += log.line(at).size();
  CHECK(bytes < LineLog::kRoom + 30 * kLong);
  CHECK(log.line(log.first()).ends_with(",\"full\":true}\n"));
  CHECK(log.tick(log.first()) > 900u);
  // A place that is gone: what was not begun is skipped, what was begun is read to its end.
  CHECK(read_all(log, place).starts_with("id: 9"));
  CHECK(read_all(log, half, 4096).starts_with(event(0, true).substr(10) + "id: 9"));
}

}  // namespace
}  // namespace lockstep::host
