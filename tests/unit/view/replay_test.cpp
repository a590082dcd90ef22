// A recording back and forth: the timeline against reading forward, what keys do, what is drawn.
#include <catch2/catch.hpp>
#include <sstream>

#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "show/view/lines_below.h"
#include "show/view/replay/replay_view.h"
#include "unit/recording/random_recording.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {

std::ostream& operator<<(std::ostream& out, const TimelineTick& moment) {
  return out << "tick " << moment.tick << " (number " << moment.number << ")";
}

namespace {

using test::random_recording;
using test::RandomRecording;
using test::TemporaryPath;
using test::WatchedRun;

// A timeline over text, and what it reads from.
struct Opened {
  explicit Opened(const std::string& text, const TimelineOptions& options = {})
      : in(text), reader(in, "run.jsonl"), timeline(reader, options) {}
  std::istringstream in;
  RecordingReader reader;
  RecordingTimeline timeline;
};

TEST_CASE("each tick, read backwards, is as when it is read forwards") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const RandomRecording recording = random_recording(random);
    // From a keyframe for each tick to none but the first, and with so little memory that some are
    // dropped.
    const TimelineOptions options{.distance = std::uint64_t{1} << (seed % 14),
                                  .most_memory = seed % 3 == 0 ? 2000u : 1u << 20};
    Opened opened(recording.text(), options);
    RecordingTimeline& timeline = opened.timeline;
    CAPTURE(seed);
    REQUIRE(timeline.outcome().error == "");
    REQUIRE(timeline.size() == recording.ticks.size());
    for (const TimelineTick& expected : recording.ticks) {
      REQUIRE(timeline.now() == expected);
      timeline.step_forward();
    }
    for (auto expected = recording.ticks.rbegin(); expected != recording.ticks.rend(); ++expected) {
      REQUIRE(timeline.now() == *expected);
      timeline.step_back();
    }
    CHECK(timeline.now() == recording.ticks.front());
    CHECK(!timeline.failed());
  }
}

TEST_CASE("jumps anywhere arrive at the tick, or at the last before it when it is lost") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const RandomRecording recording = random_recording(random);
    Opened opened(recording.text(), {.distance = 300, .most_memory = 4000});
    RecordingTimeline& timeline = opened.timeline;
    CHECK(timeline.first_tick() == recording.ticks.front().tick);
    CHECK(timeline.last_tick() == recording.ticks.back().tick);
    for (int jump = 0; jump < 100; ++jump) {
      const auto tick = random() % (timeline.last_tick() + 10);
      const TimelineTick* expected = &recording.ticks.front();
      for (const TimelineTick& moment : recording.ticks) {
        if (moment.tick <= tick) expected = &moment;
      }
      timeline.go_to_tick(tick);
      CAPTURE(seed, tick);
      REQUIRE(timeline.now() == *expected);
    }
    timeline.go_to_end();
    CHECK(timeline.now() == recording.ticks.back());
    timeline.step_forward();
    CHECK(timeline.now() == recording.ticks.back());
    timeline.go_to_begin();
    CHECK(timeline.now() == recording.ticks.front());
  }
}

TEST_CASE("the memory of keyframes has a limit however long the recording is") {
  std::mt19937 random(1);
  const std::string text = random_recording(random, {.nodes = 20, .ticks = 2000}).text();
  Opened many(text, {.distance = 1, .most_memory = 1u << 30});
  CHECK(many.timeline.keyframes() == 2000);
  Opened few(text, {.distance = 1, .most_memory = 20'000});
  CHECK(few.timeline.keyframes() > 10);
  CHECK(few.timeline.keyframes() * 20 * sizeof(RecordedState) <= 20'000);
}

TEST_CASE("of a damaged or cut recording there are the ticks before it") {
  std::mt19937 random(2);
  const RandomRecording recording = random_recording(random, {.ticks = 20, .gaps = false});
  const std::string text = recording.text();
  const auto line = text.find("{\"tick\":12,");
  Opened cut(text.substr(0, line + 9), {.distance = 100});
  CHECK(cut.timeline.size() == 12);
  CHECK(cut.timeline.outcome().cut == "line 14 is cut, the run did not end there");
  Opened damaged(text.substr(0, line) + "?" + text.substr(line), {.distance = 100});
  CHECK(damaged.timeline.size() == 12);
  CHECK(damaged.timeline.outcome().error == "run.jsonl:14: not JSON");
  for (Opened* opened : {&cut, &damaged}) {
    opened->timeline.go_to_end();
    CHECK(opened->timeline.now() == recording.ticks[11]);
    opened->timeline.step_back();
    CHECK(opened->timeline.now() == recording.ticks[10]);
    CHECK(!opened->timeline.failed());
  }
}

TEST_CASE("a recording that gets shorter while it is replayed is reported, not misread") {
  std::mt19937 random(3);
  const std::string text = random_recording(random, {.ticks = 40, .gaps = false}).text();
  Opened opened(text, {.distance = 100});
  opened.timeline.go_to_tick(5);
  opened.in.str(text.substr(0, text.size() / 2));
  opened.timeline.go_to_end();
  CHECK(opened.timeline.failed());
}

TEST_CASE("a replay from the middle does not know when the first values became so") {
  Opened opened(
      R"({"lockstep_recording":1,"tree":"T","file":"t.xml","version":"1","rate_hz":10,)"
      R"("clock":"virtual","seed":0,"arguments":{},"nodes":[{"index":0,"path":"T/a","kind":"Wait",)"
      R"("name":"a","parent":null}],"entries":[{"key":"goal","type":"number"},)"
      R"({"key":"door","type":"string"}],"first_tick":5})"
      "\n"
      R"({"tick":5,"time_s":0.5,"nodes":[],"whole":[[0,"3"],[1,"shut"]]})"
      "\n"
      R"({"tick":6,"time_s":0.6,"nodes":[],"entries":[[1,"open"]]})"
      "\n");
  const RecordingHeader& header = opened.reader.header();
  const auto lines = [&] {
    return entry_lines(header, snapshot_of(header, opened.timeline.now(), nullptr), {.width = 80},
                       10);
  };
  CHECK(lines() == "goal = 3\ndoor = shut\n");
  opened.timeline.step_forward();
  CHECK(lines() == "door = open  tick 6\ngoal = 3\n");
  opened.timeline.step_back();
  CHECK(lines() == "goal = 3\ndoor = shut\n");
}

std::optional<Key> decode(KeyDecoder& decoder, std::string_view bytes) {
  std::optional<Key> last;
  for (const char byte : bytes) last = decoder.take(byte);
  return last;
}

TEST_CASE("keys as terminals send them") {
  KeyDecoder decoder;
  CHECK(decode(decoder, "n") == Key{KeyKind::Character, 'n'});
  CHECK(decode(decoder, "\x1b[C") == Key{KeyKind::Right});
  CHECK(decode(decoder, "\x1bOD") == Key{KeyKind::Left});
  CHECK(decode(decoder, "\x1b[A") == Key{KeyKind::Up});
  CHECK(decode(decoder, "\x1bOB") == Key{KeyKind::Down});
  CHECK(decode(decoder, "\x1b[5~") == Key{KeyKind::PageUp});
  CHECK(decode(decoder, "\x1b[6~") == Key{KeyKind::PageDown});
  CHECK(decode(decoder, "\x1b[H") == Key{KeyKind::Home});
  CHECK(decode(decoder, "\x1b[4~") == Key{KeyKind::End});
  CHECK(decode(decoder, "\r") == Key{KeyKind::Enter});
  CHECK(decode(decoder, "\x7f") == Key{KeyKind::Backspace});
  CHECK(decode(decoder, "\x1b[1;5C") == std::nullopt);  // Ctrl and right: not a 'C'
  CHECK(decode(decoder, "\x1bq") == std::nullopt);      // Alt and q
  CHECK(decode(decoder, "q") == Key{KeyKind::Character, 'q'});
  CHECK(decode(decoder, "\x1b") == std::nullopt);
  CHECK(decoder.idle() == Key{KeyKind::Escape});
  CHECK(decoder.idle() == std::nullopt);
}

// Ticks 0, 1, 2, 6, 7 … at 10 Hz.
std::string with_gap() {
  std::mt19937 random(4);
  RandomRecording recording = random_recording(random, {.ticks = 20, .gaps = false});
  for (std::size_t i = 3; i < recording.ticks.size(); ++i) {
    recording.ticks[i].tick += 3;
    recording.ticks[i].time += 0.3;
  }
  recording.ticks[3].lost = 3;
  for (TimelineTick& moment : recording.ticks) moment.faults.clear();
  return recording.text();
}

struct Played {
  explicit Played(const std::string& text, double speed = 1)
      : opened(text), player(opened.timeline, speed) {}
  void press(std::string_view characters) {
    for (const char character : characters) {
      if (character == '\r') {
        player.press({KeyKind::Enter});
      } else {
        player.press({KeyKind::Character, character});
      }
    }
  }
  std::uint64_t tick() const { return opened.timeline.now().tick; }
  Opened opened;
  ReplayPlayer player;
};

TEST_CASE("a replay keeps the recorded times, at its speed, and stops at the end") {
  Played played(with_gap(), 2);
  CHECK(*played.player.wait() == Approx(0.05));
  played.player.pass(0.049);
  CHECK(played.tick() == 0);
  played.player.pass(0.002);
  CHECK(played.tick() == 1);
  played.player.pass(0.05);
  CHECK(played.tick() == 2);
  played.player.pass(0.15);  // the gap takes its time
  CHECK(played.tick() == 2);
  played.player.pass(0.05);
  CHECK(played.tick() == 6);
  played.player.pass(100);
  CHECK(played.tick() == 22);
  CHECK(played.player.paused());
  CHECK(played.player.wait() == std::nullopt);
  played.press(" ");
  CHECK(played.tick() == 0);
  CHECK(!played.player.paused());
}

TEST_CASE("a paused replay stands still, steps pause it") {
  Played played(with_gap());
  played.press(" ");
  played.player.pass(100);
  CHECK(played.tick() == 0);
  CHECK(played.player.wait() == std::nullopt);
  played.press("nnn");
  CHECK(played.tick() == 6);
  played.press("p");
  CHECK(played.tick() == 2);
  played.press("ppppp");
  CHECK(played.tick() == 0);
  played.press(" ");
  CHECK(!played.player.paused());
  played.player.press({KeyKind::Right});
  CHECK(played.player.paused());
  CHECK(played.tick() == 1);
  played.player.press({KeyKind::End});
  CHECK(played.tick() == 22);
  played.player.press({KeyKind::Left});
  CHECK(played.tick() == 21);
  played.player.press({KeyKind::Home});
  CHECK(played.tick() == 0);
}

TEST_CASE("a jump to a tick by its number, and what cannot be reached") {
  Played played(with_gap());
  played.press(" g12\r");
  CHECK(played.tick() == 12);
  CHECK(played.player.notice() == "");
  played.press("g4\r");
  CHECK(played.tick() == 2);
  CHECK(played.player.notice() == "tick 4 is not in the recording; this is the last before it");
  played.press("g999");
  CHECK(*played.player.typed() == "999");
  played.press("\r");
  CHECK(played.tick() == 2);
  CHECK(played.player.notice() == "no tick 999: the recording has 0 to 22");
  played.press("g1");
  played.player.press({KeyKind::Backspace});
  played.press("7\r");
  CHECK(played.tick() == 7);
  played.press("g8");
  played.player.press({KeyKind::Escape});
  CHECK(!played.player.typed());
  CHECK(played.tick() == 7);
  played.press("g99999999999999999999999999\r");
  CHECK(played.tick() == 7);
}

TEST_CASE("the speed is doubled and halved, within limits") {
  Played played(with_gap());
  played.press("++");
  CHECK(played.player.speed() == 4);
  played.press("---");
  CHECK(played.player.speed() == 0.5);
  played.press(std::string(100, '+'));
  CHECK(played.player.speed() == ReplayPlayer::kFastest);
  played.press(std::string(100, '-'));
  CHECK(played.player.speed() == ReplayPlayer::kSlowest);
}

// What the ticker said of each node after each tick.
struct Activities final : Observer {
  void after_tick(const Moment& moment, const TickReport&) override {
    ticks.emplace_back(moment.activity.begin(), moment.activity.end());
  }
  std::vector<std::vector<Activity>> ticks;
};

TEST_CASE("a replay shows each node as the live view of the run does") {
  const TemporaryPath file;
  WatchedRun run("Sequence(ParallelAbsolute[barriers=.5;1](a Sequence[memory=true](b c)) d)",
                 "a+.05 b+.3 c+.2 d=RRF");
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  Activities live;
  run.watch({&recorder, &live});
  Opened opened(file.text());
  const RecordingHeader& header = opened.reader.header();
  REQUIRE(opened.timeline.size() == live.ticks.size());
  bool any_held = false;
  for (const std::vector<Activity>& expected : live.ticks) {
    const Snapshot snapshot = snapshot_of(header, opened.timeline.now(), nullptr);
    for (NodeIndex node = 0; node < expected.size(); ++node) {
      CHECK(snapshot.nodes[node].activity == expected[node]);
      any_held = any_held || expected[node] == Activity::Paused;
    }
    opened.timeline.step_forward();
  }
  CHECK(any_held);
  const RecordedEnd* const end = &*opened.timeline.outcome().end;
  CHECK(draw(header, snapshot_of(header, opened.timeline.now(), end),
             {.width = 72, .height = 24}) == draw(shape_of(run.run.tree()),
                                                  snapshot_of(header, opened.timeline.now(), end),
                                                  {.width = 72, .height = 24}));
}

TEST_CASE("the last tick of a replay has the result of the run") {
  const auto first_line = [](std::string_view leaf) {
    const TemporaryPath file;
    WatchedRun run("Parallel[success_count=1](AlwaysSuccess a)", leaf);
    Recorder recorder(shape_of(run.run.tree()),
                      {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
    run.watch({&recorder});
    Opened opened(file.text());
    const std::string text = draw(
        opened.reader.header(),
        snapshot_of(opened.reader.header(), opened.timeline.now(), &*opened.timeline.outcome().end),
        {.width = 72, .height = 24});
    return text.substr(0, text.find('\n'));
  };
  CHECK(first_line("a=R") == "Test  10 Hz (virtual)  tick 0  0.000 s  success");
  CHECK(first_line("a=X") == "Test  10 Hz (virtual)  tick 0  0.000 s  fault");
}

TEST_CASE("below the tree: where the replay is, what is missing, which keys there are") {
  Played played(with_gap());
  played.press(" nnn");
  const RecordingHeader& header = played.opened.reader.header();
  const auto status = [&](unsigned height) {
    const Snapshot now = snapshot_of(header, played.opened.timeline.now(), nullptr);
    const std::string text =
        draw_replay(header, now, played.player, {.width = 100, .height = height});
    CHECK(std::count(text.begin(), text.end(), '\n') < static_cast<std::ptrdiff_t>(height));
    return text.substr(text.rfind('\n', text.rfind('\n', text.size() - 2) - 1) + 1);
  };
  CHECK(status(24) ==
        "paused  tick 6 of 22  0.600 of 2.200 s  speed 1  3 ticks lost before this\n"
        "space continue  p n step  g go to tick  home end  + - speed  q quit\n");
  played.press("g12");
  CHECK(status(6).ends_with("\ngo to tick: 12_\n"));
  played.press("\r ");
  CHECK(status(24).starts_with("plays  tick 12 of 22"));
}

}  // namespace
}  // namespace lockstep::host
