// A reader that begins in the middle of a recording knows what one knows that has read all of it.
#include <catch2/catch.hpp>
#include <random>
#include <sstream>

#include "base/compression/decompressed.h"
#include "record/read/recording_reader.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::TemporaryPath;
using test::WatchedRun;

constexpr std::uint64_t kTicks = 20'000;

// Many lines, some with a whole state, and far more bytes than a reader reads at once.
std::string record(std::uint64_t whole_each, bool compresses) {
  const TemporaryPath file;
  WatchedRun run(
      "Repeat[times=100000](Sequence[memory=true](ParallelAbsolute[barriers=.5;1](a b) c))",
      "a+.25 b+.05 c=RRRS...");
  Recorder recorder(shape_of(run.run.tree()), {.path = file.path(),
                                               .run = {.tree_file = "a.xml", .rate_hz = 10},
                                               .whole_each = whole_each,
                                               .compresses = compresses});
  run.watch({&recorder}, kTicks);
  CHECK(recorder.error() == "");
  return file.text();
}

struct Text {
  explicit Text(const std::string& file) : in(file), buffer(*in.rdbuf()), text(&buffer) {}
  std::istringstream in;
  Decompressed buffer;
  std::istream text;
};

std::vector<std::vector<RecordedState>> states_of(const std::string& file) {
  Text text(file);
  RecordingReader reader(text.text, "all");
  std::vector<std::vector<RecordedState>> states;
  while (const auto tick = reader.next()) {
    states.emplace_back(tick->nodes.begin(), tick->nodes.end());
  }
  CHECK(reader.error() == "");
  return states;
}

TEST_CASE("a recording can be read from any tick on") {
  constexpr std::uint64_t kEach = 100;
  for (const bool compresses : {false, true}) {
    const std::string file = record(kEach, compresses);
    const auto states = states_of(file);
    REQUIRE(states.size() == kTicks);
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i) {
      const std::uint64_t wanted = i == 0 ? kTicks - 1 : i == 1 ? 0 : random() % kTicks;
      Text text(file);
      RecordingReader reader(text.text, "part");
      reader.skip_to(wanted);
      std::uint64_t read = 0;
      auto tick = reader.next();
      for (; tick && tick->tick < wanted; tick = reader.next()) ++read;
      REQUIRE(tick);
      CHECK(tick->tick == wanted);
      CHECK(std::ranges::equal(tick->nodes, states[wanted]));
      CHECK(read <= kEach);
      CHECK(reader.error() == "");
    }
  }
}

TEST_CASE(
    "a recording without whole states, or in a stream that cannot be sought, is read from its "
    "begin") {
  const std::string file = record(2 * kTicks, false);
  Text text(file);
  RecordingReader reader(text.text, "part");
  reader.skip_to(kTicks / 2);
  CHECK(reader.next()->tick == 0);

  struct Pipe final : std::streambuf {
    explicit Pipe(std::string bytes) : bytes_(std::move(bytes)) {
      setg(bytes_.data(), bytes_.data(), bytes_.data() + bytes_.size());
    }
    std::string bytes_;
  } pipe(record(100, true));
  Decompressed buffer(pipe);
  std::istream in(&buffer);
  RecordingReader piped(in, "pipe");
  piped.skip_to(kTicks / 2);
  std::uint64_t ticks = 0;
  while (piped.next()) ++ticks;
  CHECK(ticks == kTicks);
  CHECK(piped.error() == "");
}

TEST_CASE("a compressed recording that was cut has no table, and is read from any tick on") {
  const std::string whole = record(100, true);
  const std::string cut = whole.substr(0, whole.size() / 2);
  const auto states = states_of(cut);
  REQUIRE(states.size() > 1000);
  Text text(cut);
  RecordingReader reader(text.text, "cut");
  const std::uint64_t wanted = states.size() - 500;
  reader.skip_to(wanted);
  auto tick = reader.next();
  CHECK(tick->tick + 100 >= wanted);
  while (tick && tick->tick < wanted) tick = reader.next();
  REQUIRE(tick);
  CHECK(std::ranges::equal(tick->nodes, states[wanted]));
}

TEST_CASE("a line that only says that it has the whole state is an error") {
  std::string text = record(100, false);
  const std::string mark = ",\"whole\":[]";
  const std::string other = ",\"x\":{\"y\":0" + mark + "}";
  for (auto at = text.find(mark); at != std::string::npos;
       at = text.find(mark, at + other.size())) {
    text.replace(at, mark.size(), other);
  }
  Text it(text);
  RecordingReader reader(it.text, "r.jsonl");
  reader.skip_to(kTicks / 2);
  CHECK_FALSE(reader.next());
  CHECK(reader.error().starts_with("r.jsonl: before byte "));
  CHECK(reader.error().ends_with(": 'whole' is missing"));
}

TEST_CASE("whole states are left out where they would be most of a recording") {
  std::string leaves;
  for (int i = 0; i < 100; ++i) leaves += " a";
  const TemporaryPath file;
  WatchedRun run("Parallel(" + leaves.substr(1) + ")", "a=R");  // nothing happens
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml"}, .whole_each = 1});
  run.watch({&recorder}, 600);
  const std::string text = file.text();
  const auto first = text.find("\"whole\"");
  CHECK(first != std::string::npos);
  CHECK(text.find("\"whole\"", first + 1) == std::string::npos);
}

}  // namespace
}  // namespace lockstep::host
