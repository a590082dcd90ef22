#include "support/synchronized_trace.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/synchronized.h"
#include "support/scripted_run.h"

namespace lockstep::test {
namespace {

struct Outcome {
  std::string who;
  std::vector<std::vector<double>> progress;
  double distance = 0;
  Status status = Status::Running;
};

double spread(std::span<const double> progress) {
  double sum = 0;
  for (const double one : progress) {
    for (const double other : progress) sum += std::abs(one - other) / 2;
  }
  return sum;
}

std::vector<bool> succeeded_children(const Ticker& ticker) {
  std::vector<bool> list;
  for (NodeIndex child = 1; child != ticker.end_of(0); child = ticker.end_of(child)) {
    list.push_back(ticker.status(child) == Status::Success);
  }
  return list;
}

std::string who_is_ticked(const Ticker& ticker, const std::vector<bool>& had_succeeded) {
  std::string who;
  NodeIndex child = 1;
  for (const bool done : had_succeeded) {
    const char digit = static_cast<char>('1' + who.size());
    who += ticker.ticked(child) ? digit : done ? '.' : '-';
    child = ticker.end_of(child);
  }
  return who;
}

Outcome play(const SynchronizedTrace& trace, std::size_t ticks) {
  ScriptedRun run(trace.tree, trace.leaves);
  Outcome outcome;
  for (std::size_t tick = 0; tick < ticks && outcome.status == Status::Running; ++tick) {
    const auto had_succeeded = succeeded_children(run.ticker());
    outcome.status = run.tick(tick * std::chrono::milliseconds(100));
    const auto progress = child_progress(run.ticker(), 0);
    outcome.who += (tick == 0 ? "" : " ") + who_is_ticked(run.ticker(), had_succeeded);
    outcome.progress.emplace_back(progress.begin(), progress.end());
    outcome.distance += spread(progress);
  }
  return outcome;
}

void check_progress(std::string_view expected, const Outcome& outcome) {
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
    const Outcome outcome = play(trace, ticks + 1);
    CHECK(outcome.who == trace.who);
    CHECK(outcome.status == Status::Success);
    CHECK(outcome.distance == Approx(trace.distance).margin(1e-9));
    if (!trace.progress.empty()) check_progress(trace.progress, outcome);
  }
}

}  // namespace lockstep::test
