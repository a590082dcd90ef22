#include "convert/node_pairs.h"

#include <cmath>
#include <cstdint>

#include "core/value.h"

namespace lockstep {
namespace {

constexpr FixedAttribute kRemembers{.name = "memory", .value = "true"};
constexpr FixedAttribute kForgets{.name = "memory", .value = "false", .is_default = true};
constexpr FixedAttribute kWallClock{.name = "clock", .value = "wall"};
constexpr FixedAttribute kRepeatsResult{.name = "then_skip", .value = "false"};

constexpr NodePair kPairs[] = {
    {.theirs = "Sequence", .ours = "Sequence", .in_ours = kRemembers},
    {.theirs = "Fallback", .ours = "Fallback", .in_ours = kRemembers},
    {.theirs = "ReactiveSequence", .ours = "Sequence", .in_ours = kForgets},
    {.theirs = "ReactiveFallback", .ours = "Fallback", .in_ours = kForgets},
    {.theirs = "ParallelAbsolute", .ours = "ParallelAbsolute"},
    {.theirs = "ParallelRelative", .ours = "ParallelRelative"},
    {.theirs = "Inverter", .ours = "Inverter"},
    {.theirs = "ForceSuccess", .ours = "ForceSuccess"},
    {.theirs = "ForceFailure", .ours = "ForceFailure"},
    {.theirs = "KeepRunningUntilFailure", .ours = "KeepRunningUntilFailure"},
    {.theirs = "RunOnce", .ours = "RunOnce", .in_theirs = kRepeatsResult},
    {.theirs = "Timeout", .ours = "Timeout", .in_ours = kWallClock, .milliseconds = "msec"},
    {.theirs = "Delay", .ours = "Delay", .in_ours = kWallClock, .milliseconds = "delay_msec"},
    {.theirs = "Sleep", .ours = "Wait", .milliseconds = "msec"},
    {.theirs = "SubTree", .ours = "SubTree"},
    {.theirs = "AlwaysSuccess", .ours = "AlwaysSuccess"},
    {.theirs = "AlwaysFailure", .ours = "AlwaysFailure"},
};

}  // namespace

std::span<const NodePair> node_pairs() {
  return kPairs;
}

std::string seconds_of(std::string_view milliseconds) {
  const auto number = parse_int(milliseconds);
  return number && *number > 0 ? to_text(Value(static_cast<double>(*number) / 1000)) : "";
}

std::string milliseconds_of(std::string_view seconds) {
  const auto number = parse_double(seconds);
  if (!number || *number <= 0 || *number > 1e9) return "";
  const double milliseconds = std::round(*number * 1000);
  const bool is_exact = std::abs(milliseconds - *number * 1000) < 1e-6;
  return is_exact ? to_text(Value(static_cast<std::int64_t>(milliseconds))) : "";
}

}  // namespace lockstep
