// Shared by the three parallels: which children are ticked again, and when the node ends.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "engine/node_context.h"

namespace lockstep::host::parallel {

inline constexpr Parameter kSuccessCount{
    .name = "success_count",
    .type = ValueType::Int,
    .doc = "How many children must succeed for Success; all when absent.",
    .range = {.min = 1}};
inline constexpr Parameter kFailureCount{.name = "failure_count",
                                         .type = ValueType::Int,
                                         .doc = "How many children must fail for Failure.",
                                         .default_text = "1",
                                         .range = {.min = 1}};
inline constexpr Parameter kMemory{
    .name = "memory",
    .type = ValueType::Bool,
    .doc =
        "Do not tick again the children with actions that completed in this activation; a child "
        "without actions is ticked in every tick anyway.",
    .default_text = "true",
    .constant = true};

// The positions of the two counts in the parameters of a kind.
struct Counts {
  unsigned success_count, failure_count;
};

// A number of children that is larger than there are.
inline std::optional<RuleBreak> check_count(const ParameterValues& given, unsigned place,
                                            std::string_view name) {
  const auto* count = std::get_if<std::int64_t>(&given.values[place]);
  if (count == nullptr || given.children == 0 || *count <= given.children) return std::nullopt;
  const std::string most = std::to_string(given.children);
  return RuleBreak{
      static_cast<int>(place),
      std::string("'").append(name) + "' is more than the " + most + " children of the node",
      "give at most " + most};
}

inline std::optional<RuleBreak> check_counts(const ParameterValues& given, const Counts& counts) {
  if (given.children == 0) return std::nullopt;  // that alone is wrong
  Value& success = given.values[counts.success_count];
  if (!given.is_given(counts.success_count)) success = std::int64_t{given.children};
  if (auto broken = check_count(given, counts.success_count, kSuccessCount.name)) return broken;
  return check_count(given, counts.failure_count, kFailureCount.name);
}

template <Counts kCounts>
std::optional<RuleBreak> rule(const ParameterValues& given) {
  return check_counts(given, kCounts);
}

// The progress of the child that is the M-th when the farthest is the first: where M children will
// have arrived. One that was skipped is not there. Uses child_states, which asking must not
// change.
inline double progress_of_mth(NodeContext& context, NodeIndex self, std::int64_t m) {
  const auto numbers = context.child_states<double>(self);
  std::size_t count = 0;
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    if (context.activity(child) != Activity::Skipped) numbers[count++] = context.progress(child);
  }
  if (count == 0) return 0.0;
  const auto sorted = numbers.first(count);
  const auto wanted = sorted.begin() + (std::min(m, static_cast<std::int64_t>(count)) - 1);
  std::nth_element(sorted.begin(), wanted, sorted.end(), std::greater<>());
  const double reached = *wanted;
  std::fill(sorted.begin(), sorted.end(), 0.0);
  return reached;
}

// A guard is ticked in every tick.
inline bool is_over(const NodeContext& context, NodeIndex child) {
  return is_complete(context.status(child)) && context.is_latched(child);
}

// How many children have succeeded, failed and were skipped.
class Tally {
 public:
  Tally() = default;
  explicit Tally(const StatusCounts& counts) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts_[i] = counts[i];
    counts_[index_of(Status::Running)] = 0;
  }
  // Those that have completed count from tick to tick, if it is kept so long.
  void begin_tick() { counts_[index_of(Status::Running)] = counts_[index_of(Status::Skipped)] = 0; }
  void add(Status status) {
    if (status != Status::Running) ++counts_[index_of(status)];
  }
  std::int64_t of(Status status) const { return counts_[index_of(status)]; }

 private:
  // Without bytes that belong to none of them: where a node keeps it, doubles come behind it.
  alignas(double) std::uint32_t counts_[(index_of(kLastStatus) + 2) / 2 * 2] = {};
};

// Success is checked first. A child that was skipped in this tick counts as not there.
struct Outcome {
  bool is_success, is_failure;
  bool ends() const { return is_success || is_failure; }
};

inline Outcome outcome(const NodeContext& context, NodeIndex self, const Counts& counts,
                       const Tally& tally) {
  const std::int64_t there = context.node(self).children - tally.of(Status::Skipped);
  const std::int64_t wanted =
      std::min(context.parameter(self, counts.success_count).integer, there);
  const std::int64_t failures = tally.of(Status::Failure);
  return {.is_success = tally.of(Status::Success) >= wanted,
          .is_failure = failures >= context.parameter(self, counts.failure_count).integer ||
                        there - failures < wanted};
}

// Children that still run are halted when the node ends.
inline Status judge(NodeContext& context, NodeIndex self, const Counts& counts,
                    const Tally& tally) {
  if (tally.of(Status::Skipped) == context.node(self).children) return Status::Skipped;
  const Outcome found = outcome(context, self, counts, tally);
  if (!found.ends()) return Status::Running;
  context.halt_running_children(self);
  return found.is_success ? Status::Success : Status::Failure;
}

// Whatever the others do, no count falls, and one that is skipped asks for one less.
template <Counts kCounts>
std::optional<std::uint64_t> sure_to_end(const NodeContext& context, NodeIndex self,
                                         const StatusCounts& of_some) {
  const Tally tally(of_some);
  if (!outcome(context, self, kCounts, tally).ends()) return std::nullopt;
  const auto count = [&](Status status) { return static_cast<std::uint64_t>(tally.of(status)); };
  return count(Status::Success) << 32u | count(Status::Skipped);
}

}  // namespace lockstep::host::parallel
