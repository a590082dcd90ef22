#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "engine/nodes/kinds.h"
#include "engine/nodes/synchronized_tick.h"

namespace lockstep {
namespace {

constexpr unsigned kBarriers = 0;
constexpr unsigned kBarrierCount = 1;
constexpr unsigned kAtBarrier = 2;
constexpr parallel::Places kPlaces{.success_count = 3, .failure_count = 4};

constexpr std::string_view kAtBarrierChoices[] = {"wait", "tick"};
constexpr std::int64_t kTickAtBarrier = 1;

constexpr Parameter kParameters[] = {
    {.name = "barriers",
     .type = ValueType::DoubleList,
     .doc = "Progress values at which the children wait for each other, rising: 0.25;0.5;0.75.",
     .range = {.min = 0, .max = 1, .min_excluded = true}},
    {.name = "barrier_count",
     .type = ValueType::Int,
     .doc = "Instead of barriers: n equidistant ones, i/n for i = 1 to n; 0 = none.",
     .range = {.min = 0, .max = 100000}},
    {.name = "at_barrier",
     .type = ValueType::String,
     .doc = "What a child exactly at a barrier does: wait (the definition) or tick once more (the "
            "pseudocode).",
     .default_text = "wait",
     .choices = kAtBarrierChoices},
    parallel::kSuccessCount,
    parallel::kFailureCount,
    parallel::kMemory,
};

std::optional<RuleBreak> check_order(const std::vector<double>& barriers) {
  const auto not_rising = std::ranges::adjacent_find(barriers, std::greater_equal<>());
  if (not_rising == barriers.end()) return std::nullopt;
  auto sorted = barriers;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end()) {
    return RuleBreak{kBarriers, "barrier " + to_text(*twice) + " is given twice", ""};
  }
  constexpr std::size_t kMostShown = 20;
  return RuleBreak{kBarriers, "barriers must rise",
                   sorted.size() > kMostShown ? "" : "write '" + to_text(sorted) + "'"};
}

std::optional<RuleBreak> check_barriers(const ParameterValues& given) {
  if (given.is_given(kBarriers) && given.is_given(kBarrierCount)) {
    return RuleBreak{kBarrierCount, "both 'barriers' and 'barrier_count' are given",
                     "give exactly one of the two"};
  }
  if (!given.is_given(kBarriers) && !given.is_given(kBarrierCount)) {
    return RuleBreak{-1, "'barriers' or 'barrier_count' is missing",
                     "give exactly one of the two, such as barriers=\"0.25;0.5;0.75\""};
  }
  const auto* barriers = std::get_if<std::vector<double>>(&given.values[kBarriers]);
  if (barriers != nullptr) return check_order(*barriers);
  if (const auto* count = std::get_if<std::int64_t>(&given.values[kBarrierCount])) {
    std::vector<double> equidistant;
    for (std::int64_t i = 1; i <= *count; ++i) {
      equidistant.push_back(static_cast<double>(i) / static_cast<double>(*count));
    }
    given.values[kBarriers] = std::move(equidistant);
  }
  return std::nullopt;
}

std::optional<RuleBreak> rule(const ParameterValues& given) {
  if (auto broken = parallel::check_counts(given, kPlaces)) return broken;
  return check_barriers(given);
}

// The smallest barrier that not every child has passed; infinity when none is left.
double current_barrier(std::span<const double> barriers, double least) {
  const auto next = std::upper_bound(barriers.begin(), barriers.end(), least + kProgressEpsilon);
  return next == barriers.end() ? std::numeric_limits<double>::infinity() : *next;
}

Status tick(Ticker& ticker, NodeIndex self) {
  const auto barriers = ticker.numbers(ticker.parameter(self, kBarriers));
  const double least = synchronized::take_snapshot(ticker, self);
  const double barrier = current_barrier(barriers, least);
  ticker.state<SynchronizedState>(self).limit = barrier;
  if (ticker.parameter(self, kAtBarrier).integer == kTickAtBarrier) {
    return synchronized::tick_children(ticker, self, kPlaces, [barrier](double reached) {
      return reached > barrier + kProgressEpsilon;
    });
  }
  return synchronized::tick_children(ticker, self, kPlaces, [barrier](double reached) {
    return reached >= barrier - kProgressEpsilon;
  });
}

}  // namespace

const NodeKind kParallelAbsolute{
    .type = {.id = "ParallelAbsolute",
             .category = NodeCategory::Control,
             .doc = "Ticks its children in parallel and makes them wait for each other at a list "
                    "of barriers: a child that has reached the current barrier is held until all "
                    "have. Ends as "
                    "Parallel does.",
             .arity = {1},
             .parameters = kParameters,
             .rule = rule,
             .sign = "⇉A",
             .synchronization = Synchronization::Absolute},
    .tick = tick,
    .progress = synchronized::least_progress,
    .state_size = sizeof(SynchronizedState),
    .state_per_child = sizeof(double)};

}  // namespace lockstep
