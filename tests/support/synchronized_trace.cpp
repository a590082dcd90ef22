#include "support/synchronized_trace.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/synchronized.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

struct TraceOutcome {
  std::string who;
  std::vector<std::vector<double>> progress;
  double distance = 0;
  Status status = Status::Running;
};

double spread(std::span<const double> progress) {
  double sum = 0;
  for (const double one : progress) {
    for (const double other : progress) {
      if (!is_left_out(one) && !is_left_out(other)) sum += std::abs(one - other) / 2;
    }
  }
  return sum;
}

std::string who_is_ticked(const Ticker& ticker) {
  std::string who;
  for (const LeafNode& leaf : ticker.tree().leaves) {
    const char digit = static_cast<char>('1' + who.size());
    const bool runs = ticker.status(leaf.node) == Status::Running;
    who += ticker.ticked(leaf.node) ? digit : runs ? '-' : '.';
  }
  return who;
}

TraceOutcome play(const SynchronizedTrace& trace, std::size_t ticks) {
  ScriptedRun run(trace.tree, trace.leaves);
  TraceOutcome outcome;
  const auto node = synchronized_nodes(run.tree()).front();
  for (std::size_t tick = 0; tick < ticks && outcome.status == Status::Running; ++tick) {
    outcome.status = run.tick(tick * std::chrono::milliseconds(100));
    const auto progress = child_progress(run.ticker(), node);
    outcome.who += (tick == 0 ? "" : " ") + who_is_ticked(run.ticker());
    outcome.progress.emplace_back(progress.begin(), progress.end());
    outcome.distance += spread(progress);
  }
  return outcome;
}

void check_progress(std::string_view expected, const TraceOutcome& outcome) {
  for (const auto& tick : outcome.progress) {
    for (const double progress : tick) {
      CHECK(take_number(expected) == Approx(progress).margin(1e-9));
      if (!expected.empty()) expected.remove_prefix(1);
    }
  }
  CHECK(expected.empty());
}

}  // namespace

void check_traces(std::span<const SynchronizedTrace> traces) {
  for (const SynchronizedTrace& trace : traces) {
    INFO(trace.name << ": " << trace.tree << ", " << trace.leaves);
    const auto ticks =
        static_cast<std::size_t>(std::count(trace.who.begin(), trace.who.end(), ' '));
    const TraceOutcome outcome = play(trace, ticks + 1);
    CHECK(outcome.who == trace.who);
    CHECK(outcome.status == Status::Success);
    CHECK(outcome.distance == Approx(trace.distance).margin(1e-9));
    if (!trace.progress.empty()) check_progress(trace.progress, outcome);
  }
}

}  // namespace lockstep::host::test
