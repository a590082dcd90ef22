// How late our loop wakes, and how long its periods are, beside a bare loop around clock_nanosleep
// in the same run, and beside cyclictest (Debian rt-tests) where it is installed. The two take
// turns of a second each, so that both see the same machine.
//
//   bench_loop [--seconds S] [--realtime] [--cpu N] [--benchmark_out=FILE]
#include <fmt/format.h>
#include <sys/mman.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/core/histogram.h"
#include "run/loop.h"
#include "run/realtime.h"
#include "run/run.h"
#include "support/compiled.h"

namespace {

using namespace lockstep::host;
using Json = nlohmann::ordered_json;

struct Samples {
  Histogram latency;  // from the deadline to the wake-up
  Histogram jitter;   // how far a period is from the set one

  void add(Nanoseconds deadline, Nanoseconds woken, Nanoseconds previous, Nanoseconds period) {
    latency.record(woken - deadline);
    if (previous.count() != 0)
      jitter.record(Nanoseconds(std::abs((woken - previous - period).count())));
  }
};

Tree endless_tree() {
  return test::compiled(
      "<root lockstep='1'><BehaviorTree ID='Loop'><KeepRunningUntilFailure><AlwaysSuccess/>"
      "</KeepRunningUntilFailure></BehaviorTree></root>");
}

class Watcher final : public Observer {
 public:
  Watcher(Samples& samples, Nanoseconds period) : samples_(samples), period_(period) {}
  // The first tick waits for nothing; after a skipped deadline the next is as late as planned.
  void before_tick(const Moment&, std::uint64_t tick, Nanoseconds time) override {
    const Nanoseconds deadline = time - time % period_;
    if (tick > 0) samples_.add(deadline, time, previous_, period_);
    previous_ = time;
  }

 private:
  Samples& samples_;
  Nanoseconds period_;
  Nanoseconds previous_{0};
};

void our_turn(const Tree& tree, Nanoseconds period, std::uint64_t ticks, Samples& samples) {
  Run run(tree, {.rate = 1.0 / to_seconds(period)});
  WallClock clock;
  Watcher watcher(samples, period);
  Observer* const observers[] = {&watcher};
  run_loop(run, clock, {.rate = 1.0 / to_seconds(period), .max_ticks = ticks}, observers);
}

void bare_turn(Nanoseconds period, std::uint64_t ticks, Samples& samples) {
  WallClock clock;
  const Nanoseconds start = clock.now();
  Nanoseconds previous{0};
  for (std::uint64_t tick = 1; tick < ticks; ++tick) {
    clock.sleep_until(start + tick * period);
    const Nanoseconds woken = clock.now() - start;
    samples.add(tick * period, woken, previous, period);
    previous = woken;
  }
}

struct Row {
  std::string who;
  double p50, p99, p999, max;  // microseconds
  double jitter99;             // of the period
};

double microseconds(Nanoseconds time) {
  return to_seconds(time) * 1e6;
}

Row row_of(std::string who, const Samples& samples) {
  const auto at = [&](double q) { return microseconds(samples.latency.quantile(q)); };
  return {std::move(who),
          at(0.5),
          at(0.99),
          at(0.999),
          microseconds(samples.latency.max()),
          microseconds(samples.jitter.quantile(0.99))};
}

// cyclictest's histogram: a line "microseconds count" for each bucket.
std::optional<Row> cyclictest(Nanoseconds period, std::uint64_t ticks, bool realtime) {
  const std::string command =
      fmt::format("cyclictest -q -t1 -h 20000 -i {} -l {} {} 2>/dev/null", period.count() / 1000,
                  ticks, realtime ? "-m -p 80" : "--policy=other");
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  Samples samples;
  char line[256];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    unsigned microseconds = 0, count = 0;
    if (std::sscanf(line, "%u %u", &microseconds, &count) != 2) continue;
    for (unsigned i = 0; i < count; ++i) {
      samples.latency.record(std::chrono::microseconds(microseconds));
    }
  }
  if (pclose(pipe) != 0 || samples.latency.count() == 0) return std::nullopt;
  Row row = row_of("cyclictest", samples);
  row.jitter99 = std::nan("");
  return row;
}

Json json_of(const Row& row, Nanoseconds period) {
  return {{"period_ms", to_seconds(period) * 1e3},
          {"loop", row.who},
          {"p50_us", row.p50},
          {"p99_us", row.p99},
          {"p99.9_us", row.p999},
          {"max_us", row.max},
          {"period_jitter_p99_us", row.jitter99}};
}

void print(const Row& row, const Row& bare, Nanoseconds period) {
  fmt::print("{:>6} ms  {:<11} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.1f} {:>13.1f} {:>14.2f}\n",
             to_seconds(period) * 1e3, row.who, row.p50, row.p99, row.p999, row.max, row.jitter99,
             row.p999 / bare.p999);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How late the loop wakes, beside a bare clock_nanosleep loop");
  double seconds = 20;
  RealtimeOptions realtime;
  std::string out, format;
  app.add_option("--seconds", seconds, "Of each loop and period")->capture_default_str();
  app.add_flag("--realtime", realtime.realtime, "SCHED_FIFO, memory locked");
  std::string cpu;
  app.add_option("--cpu", cpu, "Stay on these processors, as 1 or 0-1");
  app.add_option("--benchmark_out", out, "Write the results as JSON");
  app.add_option("--benchmark_out_format", format, "json");
  CLI11_PARSE(app, argc, argv);
  if (!cpu.empty()) realtime.processors = Processors::parse(cpu);
  const auto missing = apply_realtime(realtime);
  for (const Problem& problem : missing) fmt::print(stderr, "{}\n", problem.message);
  if (!missing.empty()) return 1;

  const Tree tree = endless_tree();
  Json results = Json::array();
  fmt::print(
      "wake-up latency, us           p50       p99     p99.9       max  period p99 +-  "
      "p99.9 / bare\n");
  for (const Nanoseconds period : {Nanoseconds(1'000'000), Nanoseconds(10'000'000)}) {
    const auto ticks = static_cast<std::uint64_t>(1.0 / to_seconds(period));
    Samples bare, ours;
    for (double done = 0; done < seconds; done += 1) {
      bare_turn(period, ticks, bare);
      our_turn(tree, period, ticks, ours);
    }
    std::vector<Row> rows = {row_of("bare", bare), row_of("lockstep", ours)};
    const auto all = static_cast<std::uint64_t>(seconds) * ticks;
    if (const auto row = cyclictest(period, all, realtime.realtime)) rows.push_back(*row);
    for (const Row& row : rows) {
      print(row, rows.front(), period);
      results.push_back(json_of(row, period));
    }
  }
  if (!out.empty()) std::ofstream(out) << results.dump(2) << '\n';
  return 0;
}
