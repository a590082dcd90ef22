// The recorder when the disk is slow or fails. What it writes when all is well: recording_test.cpp.
#include "record/write/recorder.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "record/read/recording_reader.h"
#include "run/shape_of.h"
#include "unit/recording/blocked_disk.h"

namespace lockstep::host {
namespace {

using test::BlockedDisk;
using test::TemporaryPath;
using test::WatchedRun;

// One tick after the other, as long as a test wants.
class SteppedRun {
 public:
  SteppedRun(std::string_view tree, std::string_view leaves) : run_(tree, leaves) {}

  const Tree& tree() { return run_.run.tree(); }
  std::uint64_t ticks() const { return ticks_; }
  void start(Observer& observer, bool real_time) {
    moments_.begin(ticker());
    observer.run_started(moments_.now(ticker()), {.period = kPeriod, .real_time = real_time});
    observers_.push_back(&observer);
  }
  void tick() {
    const Nanoseconds now = kPeriod * static_cast<std::int64_t>(ticks_);
    for (Observer* observer : observers_) {
      observer->before_tick(moments_.now(ticker()), ticks_, now);
    }
    TickReport report;
    report.tick = ticks_++;
    report.time = now;
    report.status = ticker().tick_root(now);
    const Moment& moment = moments_.after_tick(ticker(), report.tick, now);
    for (Observer* observer : observers_) observer->after_tick(moment, report);
  }
  void end() {
    RunEnd end;
    end.ticks = ticks_;
    for (Observer* observer : observers_) observer->run_ended(moments_.now(ticker()), end);
  }

 private:
  static constexpr Nanoseconds kPeriod = std::chrono::milliseconds(100);
  Ticker& ticker() { return run_.run.ticker(); }

  WatchedRun run_;
  LiveMoments moments_{run_.run.tree(), {.within = true, .progress_within = true}};
  std::vector<Observer*> observers_;
  std::uint64_t ticks_ = 0;
};

// Two ticks of the same run, as two recordings tell them.
void check_same(const RecordedTick& one, const RecordedTick& other) {
  REQUIRE(one.tick == other.tick);
  REQUIRE(std::equal(one.nodes.begin(), one.nodes.end(), other.nodes.begin(), other.nodes.end()));
}

TEST_CASE("a disk that is too slow loses ticks, the recording says which, the rest is right") {
  // `a` completes while nothing is written, and changes no more.
  const std::string leaves = "a=" + std::string(400, 'R') + "S b=R";
  BlockedDisk disk;
  const TemporaryPath complete;
  std::uint64_t lost = 0, ticks = 0;
  {
    SteppedRun run("Sequence[memory=true](a b)", leaves);
    Recorder recorder(shape_of(run.tree()),
                      {.path = disk.path(), .run = {.tree_file = "a.xml"}, .queue = 0});
    Recorder reference(shape_of(run.tree()),
                       {.path = complete.path(), .run = {.tree_file = "a.xml"}});
    run.start(recorder, true);
    run.start(reference, false);
    while (run.ticks() < 600) run.tick();
    REQUIRE(recorder.lost() > 300);
    disk.unblock();
    // Until ticks are taken again.
    for (int taken = 0; taken < 20;) {
      const std::uint64_t before = recorder.lost();
      run.tick();
      taken += recorder.lost() == before;
      REQUIRE(run.ticks() < 1'000'000);
    }
    run.end();
    lost = recorder.lost();
    ticks = run.ticks();
    CHECK(recorder.error() == "");
  }
  std::istringstream in(disk.text()), all(complete.text());
  RecordingReader reader(in, "lost.jsonl"), reference(all, "complete.jsonl");
  std::uint64_t read = 0;
  while (const auto tick = reader.next()) {
    ++read;
    auto expected = reference.next();
    while (expected && expected->tick < tick->tick) expected = reference.next();
    REQUIRE(expected);
    check_same(*tick, *expected);
  }
  CHECK(reader.error() == "");
  CHECK(read + lost == ticks);
  const std::string gaps = reader.gaps(), first = "the first is ";
  CHECK(gaps.starts_with(std::to_string(lost) + " ticks are missing, "));
  CHECK(std::stoul(gaps.substr(gaps.find(first) + first.size())) < 400);
  REQUIRE(reader.end());
  CHECK(reader.end()->lost == lost);
}

TEST_CASE("ticks lost at the end are reported before the closing line") {
  BlockedDisk disk;
  std::uint64_t lost = 0;
  {
    SteppedRun run("Sequence(a)", "a=R");
    Recorder recorder(shape_of(run.tree()),
                      {.path = disk.path(), .run = {.tree_file = "a.xml"}, .queue = 0});
    run.start(recorder, true);
    while ((lost = recorder.lost()) < 10) run.tick();
    disk.unblock();
    run.end();
  }
  const std::string text = disk.text();
  // An earlier gap may be there: the writing thread may be late before the disk is full.
  const std::size_t gap = text.rfind("{\"lost\":{\"ticks\":");
  REQUIRE(gap != std::string::npos);
  CHECK(text.compare(text.find('\n', gap) + 1, 7, "{\"end\":") == 0);
  CHECK(text.ends_with("\"skipped\":0,\"lost\":" + std::to_string(lost) + "}}\n"));
}

TEST_CASE("on the virtual clock the run waits for the disk instead") {
  const std::string tree = "Repeat[times=500](a)", leaves = "a=RS...";
  const auto record = [&](const std::string& path, std::size_t queue) {
    WatchedRun run(tree, leaves);
    Recorder recorder(shape_of(run.run.tree()),
                      {.path = path, .run = {.tree_file = "a.xml"}, .queue = queue});
    run.watch({&recorder}, 5000);
    CHECK(recorder.lost() == 0);
  };
  BlockedDisk disk;
  disk.unblock();
  record(disk.path(), 0);
  const TemporaryPath file;
  record(file.path(), AppendFile::kQueue);
  CHECK(disk.text() == file.text());
}

TEST_CASE("an error while the run goes on is reported within a tick of its being known") {
  BlockedDisk disk;
  std::string told;
  SteppedRun run("Sequence(a)", "a=R");
  Recorder recorder(shape_of(run.tree()),
                    {.path = disk.path(),
                     .run = {.tree_file = "a.xml"},
                     .on_error = [&](const std::string& error) { told += error; },
                     .queue = 0});
  run.start(recorder, true);
  run.tick();
  CHECK_FALSE(recorder.failed());
  disk.close();
  while (!recorder.failed()) run.tick();
  run.tick();
  CHECK(told == "cannot write '" + disk.path() + "': Broken pipe");
  CHECK(recorder.error() == told);
  const std::uint64_t lost = recorder.lost();
  run.tick();
  CHECK(recorder.lost() == lost);  // it is not the queue that was full
  run.end();
  CHECK(told == recorder.error());
}

TEST_CASE("a message that is longer than the queue loses its tick, not the recording") {
  const TemporaryPath file;
  {
    WatchedRun run("Sequence(a)", "a=RRRRS");
    for (int fault = 0; fault < 100; ++fault) {
      run.faults[2].push_back({1, std::string(100000, 'x')});
    }
    Recorder recorder(shape_of(run.run.tree()),
                      {.path = file.path(), .run = {.tree_file = "a.xml"}, .queue = 0});
    run.watch({&recorder});
  }
  std::istringstream in(file.text());
  RecordingReader reader(in, "run.jsonl");
  std::uint64_t ticks = 0;
  while (reader.next()) ++ticks;
  CHECK(reader.error() == "");
  CHECK(ticks == 4);
  CHECK(reader.gaps().starts_with("1 tick is missing, the first is 2:"));
  CHECK(reader.end());
}

TEST_CASE("a recorder that cannot make MCAP refuses its name, and leaves no file") {
  WatchedRun run("Sequence(a b)", "a=S b=S");
  const TemporaryPath folder;
  const std::string path = folder.path() + ".mcap";
  {
    Recorder recorder(shape_of(run.run.tree()), {.path = path, .run = {.tree_file = "a.xml"}});
    CHECK(recorder.error().starts_with("cannot write '" + path +
                                       "': this program writes JSON Lines"));
  }
  CHECK(::access(path.c_str(), F_OK) != 0);
}

}  // namespace
}  // namespace lockstep::host
