#include "unit/recording/watched_run.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "record/write/recorder.h"
#include "run/shape_of.h"

namespace lockstep::host::test {

RunEnd WatchedRun::watch(std::initializer_list<Observer*> who, std::uint64_t max_ticks) {
  Ticker& ticker = run.ticker();
  Observers observers(run.tree(), {who.begin(), who.size()});
  observers.run_started(ticker, start);
  RunEnd end;
  end.reason = StopReason::MaxTicks;
  end.ticks = end.first_tick = start.first_tick;
  while (end.ticks < max_ticks && end.reason == StopReason::MaxTicks) {
    const std::uint64_t tick = end.ticks++;
    const Nanoseconds now = start.period * static_cast<std::int64_t>(tick);
    ticker.set_now(now);
    observers.before_tick(ticker, tick, now);
    end.status = run.tick_root(now);
    end.time = now;
    const TickReport report{
        .tick = tick, .time = now, .status = end.status, .skipped = 0, .faults = faults[tick]};
    observers.after_tick(ticker, report);
    if (is_complete(end.status)) end.reason = StopReason::Completed;
    if (ticker.fault() != nullptr) end.reason = StopReason::Fault;
  }
  observers.standing(ticker);
  ticker.halt_all();
  if (ticker.fault() != nullptr) end.fault = *ticker.fault();
  end.worst = worst;
  observers.run_ended(ticker, end);
  return end;
}

std::string TextFile::text() {
  std::fflush(file_);
  std::rewind(file_);
  std::string text;
  for (int character = std::fgetc(file_); character != EOF; character = std::fgetc(file_)) {
    text += static_cast<char>(character);
  }
  return text;
}

TemporaryPath::TemporaryPath() {
  std::string pattern = (std::filesystem::temp_directory_path() / "lockstep-XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
  path_ = folder_ + "/run.jsonl";
}

TemporaryPath::~TemporaryPath() {
  std::filesystem::remove_all(folder_);
}

std::string TemporaryPath::text() const {
  std::ostringstream text;
  text << std::ifstream(path_).rdbuf();
  return text.str();
}

std::string recorded_lines(std::string_view tree, std::string_view leaves, std::uint64_t first,
                           std::uint64_t ticks) {
  const TemporaryPath file;
  WatchedRun run(tree, leaves);
  run.start.first_tick = first;
  run.start.gap = from_seconds(first == 0 ? 0 : 2);
  Recorder recorder(shape_of(run.run.tree()),
                    {.path = file.path(), .run = {.tree_file = "a.xml", .rate_hz = 10}});
  run.watch({&recorder}, ticks);
  const std::string text = file.text();
  return text.substr(0, text.find("{\"end\""));
}

}  // namespace lockstep::host::test
