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

constexpr AttributePair kTimeout[] = {{"msec", "seconds", Conversions::Milliseconds}};
constexpr AttributePair kDelay[] = {{"delay_msec", "seconds", Conversions::Milliseconds}};
constexpr AttributePair kRepeat[] = {{"num_cycles", "times", Conversions::Rounds}};
constexpr AttributePair kRetry[] = {{"num_attempts", "attempts", Conversions::Attempts}};
constexpr AttributePair kParallel[] = {
    {"success_count", "success_count", Conversions::Children},
    {"failure_count", "failure_count", Conversions::Children},
    {"success_threshold", "success_count", Conversions::Children},  // before version 4
    {"threshold", "success_count", Conversions::Children},
    {"failure_threshold", "failure_count", Conversions::Children}};

constexpr FixedAttribute kKeepsResults{.name = "memory", .value = "true", .is_default = true};

constexpr std::string_view kRounds =
    "for BehaviorTree.CPP, a round that ends at once is followed by the next one in the same "
    "period; in lockstep's language each round takes a tick";
constexpr std::string_view kDecides =
    "for BehaviorTree.CPP, it decides after each child; in lockstep's language when all were "
    "ticked, and conditions are asked in every tick";

constexpr std::string_view kStands =
    "while it is held, the time of a Wait stands still; that of a Sleep goes on";

constexpr NodePair kPairs[] = {
    {.theirs = "Sequence", .ours = "Sequence", .in_ours = kRemembers},
    {.theirs = "Fallback", .ours = "Fallback", .in_ours = kRemembers},
    {.theirs = "ReactiveSequence", .ours = "Sequence", .in_ours = kForgets},
    {.theirs = "ReactiveFallback", .ours = "Fallback", .in_ours = kForgets},
    {.theirs = "ParallelAbsolute", .ours = "ParallelAbsolute"},
    {.theirs = "ParallelRelative", .ours = "ParallelRelative"},
    {.theirs = "Parallel",
     .ours = "Parallel",
     .in_ours = kKeepsResults,
     .attributes = kParallel,
     .difference = kDecides},
    {.theirs = "Repeat", .ours = "Repeat", .attributes = kRepeat, .difference = kRounds},
    {.theirs = "RetryUntilSuccessful",
     .ours = "Retry",
     .attributes = kRetry,
     .difference = kRounds},
    {.theirs = "Inverter", .ours = "Inverter"},
    {.theirs = "ForceSuccess", .ours = "ForceSuccess"},
    {.theirs = "ForceFailure", .ours = "ForceFailure"},
    {.theirs = "KeepRunningUntilFailure", .ours = "KeepRunningUntilFailure"},
    {.theirs = "RunOnce", .ours = "RunOnce", .in_theirs = kRepeatsResult},
    {.theirs = "Timeout", .ours = "Timeout", .in_ours = kWallClock, .attributes = kTimeout},
    {.theirs = "Delay", .ours = "Delay", .in_ours = kWallClock, .attributes = kDelay},
    {.theirs = "Sleep",
     .ours = "Wait",
     .attributes = kTimeout,
     .difference = kStands,
     .is_different_when_held = true},
    {.theirs = "SubTree", .ours = "SubTree"},
    {.theirs = "IfThenElse", .ours = "IfThenElse"},
    {.theirs = "WhileDoElse", .ours = "WhileDoElse"},
    {.theirs = "Script", .ours = "Script"},
    {.theirs = "ScriptCondition", .ours = "Check"},
    {.theirs = "AlwaysSuccess", .ours = "AlwaysSuccess"},
    {.theirs = "AlwaysFailure", .ours = "AlwaysFailure"},
};

}  // namespace

std::span<const NodePair> node_pairs() {
  return kPairs;
}

const NodePair* find_pair(Side from, std::string_view type, const GivenAttribute& given) {
  const bool is_ours = from == Side::Ours;
  for (const NodePair& pair : kPairs) {
    if ((is_ours ? pair.ours : pair.theirs) != type) continue;
    const FixedAttribute& fixed = is_ours ? pair.in_ours : pair.in_theirs;
    if (fixed.name.empty()) return &pair;
    const auto value = given(fixed.name);
    if (value ? *value == fixed.value : fixed.is_default) return &pair;
  }
  return nullptr;
}

std::optional<std::string> value_there(Conversions conversion, std::string_view ours) {
  if (conversion != Conversions::Milliseconds) return std::string(ours);
  const auto seconds = parse_double(ours);
  if (!seconds || *seconds <= 0 || *seconds > 1e9) return std::nullopt;
  const double milliseconds = std::round(*seconds * 1000);
  if (std::abs(milliseconds - *seconds * 1000) >= 1e-6) return std::nullopt;
  return to_text(Value(static_cast<std::int64_t>(milliseconds)));
}

std::optional<std::string> value_here(Conversions conversion, std::string_view theirs,
                                      std::uint32_t children) {
  const bool is_time = conversion == Conversions::Milliseconds;
  if (conversion == Conversions::None || (!is_time && theirs.starts_with('{'))) {
    return std::string(theirs);
  }
  auto number = parse_int(theirs);
  if (number && *number == -1 && conversion == Conversions::Rounds) return "";
  if (number && *number < 0 && conversion == Conversions::Children) *number += children + 1;
  if (!number || *number <= 0) return std::nullopt;
  if (is_time) return to_text(Value(static_cast<double>(*number) / 1000));
  return to_text(Value(*number));
}

std::string_view hint_of(Conversions conversion) {
  switch (conversion) {
    case Conversions::Milliseconds:
      return "only a positive number of whole milliseconds can";
    case Conversions::Rounds:
      return "only a positive number, or -1, can";
    case Conversions::Attempts:
      return "only a positive number can; a Repeat between two Inverters tries for ever";
    default:
      return "only a number of children from 1 on can";
  }
}

}  // namespace lockstep
