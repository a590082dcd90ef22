// Shared by ParallelAbsolute and barriers beside the trees: the list of barriers, and which
// children are held at one of them.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/core/node_type.h"
#include "engine/synchronized.h"

namespace lockstep::host::absolute {

// Their parameters begin with these three.
inline constexpr unsigned kBarriers = 0;
inline constexpr unsigned kBarrierCount = 1;
inline constexpr unsigned kAtBarrier = 2;

inline constexpr Parameter kBarriersParameter{
    .name = "barriers",
    .type = ValueType::DoubleList,
    .doc = "Progress values at which the children wait for each other, rising: 0.25;0.5;0.75.",
    .range = {.min = 0, .max = 1}};
inline constexpr Parameter kBarrierCountParameter{
    .name = "barrier_count",
    .type = ValueType::Int,
    .doc = "Instead of barriers: n equidistant ones, i/n for i = 1 to n; 0 = none.",
    .range = {.min = 0, .max = 100000}};
inline constexpr Parameter kAtBarrierParameter{
    .name = "at_barrier",
    .type = ValueType::String,
    .doc =
        "What a child exactly at a barrier does: wait (the definition) or tick once more (the "
        "pseudocode).",
    .default_text = "wait",
    .choices = kAtBarrierChoices};

inline std::optional<RuleBreak> check_order(const std::vector<double>& barriers) {
  const auto not_rising = std::ranges::adjacent_find(barriers, std::greater_equal<>());
  if (not_rising == barriers.end()) return std::nullopt;
  auto sorted = barriers;
  std::ranges::sort(sorted);
  std::vector<double> twice;
  for (auto it = sorted.begin(); (it = std::adjacent_find(it, sorted.end())) != sorted.end();) {
    twice.push_back(*it);
    it = std::upper_bound(it, sorted.end(), *it);
  }
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  constexpr std::size_t kMostShown = 20;
  std::string hint = sorted.size() > kMostShown ? "" : "write '" + to_text(sorted) + "'";
  if (twice.empty()) return RuleBreak{kBarriers, "barriers must rise", std::move(hint)};
  twice.resize(std::min(twice.size(), kMostShown));
  return RuleBreak{kBarriers,
                   (twice.size() == 1 ? "barrier " + to_text(twice.front()) + " is"
                                      : "barriers " + to_text(twice) + " are") +
                       " given twice",
                   std::move(hint)};
}

// Fills in the equidistant barriers that 'barrier_count' stands for. At least one of the two is
// given.
inline std::optional<RuleBreak> check_barriers(const ParameterValues& given) {
  if (given.is_given(kBarriers) && given.is_given(kBarrierCount)) {
    return RuleBreak{kBarrierCount, "both 'barriers' and 'barrier_count' are given",
                     "give exactly one of the two"};
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

// The same of a node that may have 'delta' instead, at this place.
inline std::optional<RuleBreak> check_limits(const ParameterValues& given, unsigned delta) {
  const bool is_listed = given.is_given(kBarriers) || given.is_given(kBarrierCount);
  constexpr auto kOne = "give exactly one of 'barriers', 'barrier_count' and 'delta'";
  if (is_listed && given.is_given(delta))
    return RuleBreak{static_cast<int>(delta), "both barriers and 'delta' are given", kOne};
  if (is_listed) return check_barriers(given);
  if (given.is_given(delta)) return std::nullopt;
  return RuleBreak{-1, "'barriers', 'barrier_count' or 'delta' is missing", kOne};
}

// The smallest barrier that not everybody has passed; infinity when none is left. `place` is where
// it is in the list. Most often it is where it was in the last tick.
inline double current_barrier(std::span<const double> barriers, double least,
                              std::uint32_t& place) {
  const double passed = least + kProgressEpsilon;
  const bool is_there = place < barriers.size() && passed < barriers[place] &&
                        (place == 0 || !(passed < barriers[place - 1]));
  if (is_there) return barriers[place];
  const auto next = std::upper_bound(barriers.begin(), barriers.end(), passed);
  place = static_cast<std::uint32_t>(next - barriers.begin());
  return next == barriers.end() ? std::numeric_limits<double>::infinity() : *next;
}

// A barrier at 0 holds no progress. Beside the trees, it holds members that have not begun.
inline bool begins_at_zero(std::span<const double> barriers) {
  return !barriers.empty() && barriers.front() == 0.0;
}

// The least progress that is held at the current barrier.
inline double held_from(double barrier, bool ticks_at_barrier) {
  return ticks_at_barrier ? least_above(barrier) : reached_from(barrier);
}

}  // namespace lockstep::host::absolute
