#include "dialect/btcpp/pairs.h"

#include <cmath>
#include <cstdint>

#include "base/core/value.h"

namespace lockstep::host::btcpp {
namespace {

constexpr FixedAttribute kRemembers{.name = "memory", .value = "true"};
constexpr FixedAttribute kForgets{.name = "memory", .value = "false", .is_default = true};
constexpr FixedAttribute kKeepsResults{.name = "memory", .value = "true", .is_default = true};
constexpr FixedAttribute kWallClock{.name = "clock", .value = "wall", .is_detail = true};
constexpr FixedAttribute kRepeatsResult{.name = "then_skip", .value = "false"};

constexpr AttributePair kMsec[] = {{"msec", "seconds", Conversions::Milliseconds}};
constexpr AttributePair kDelayMsec[] = {{"delay_msec", "seconds", Conversions::Milliseconds}};
constexpr AttributePair kCycles[] = {{"num_cycles", "times", Conversions::Rounds}};
constexpr AttributePair kAttempts[] = {{"num_attempts", "attempts", Conversions::Attempts}};
constexpr AttributePair kCounts[] = {
    {"success_count", "success_count", Conversions::Children},
    {"failure_count", "failure_count", Conversions::Children},
    {"success_threshold", "success_count", Conversions::Children},  // before version 4
    {"threshold", "success_count", Conversions::Children},
    {"failure_threshold", "failure_count", Conversions::Children}};
constexpr AttributePair kThenSkip[] = {{"then_skip", ""}};
constexpr AttributePair kSubTreeWords[] = {
    {"ID", "ID"}, {"__autoremap", "_autoremap"}, {"__shared_blackboard", "_autoremap"}};
constexpr AttributePair kCode[] = {{"code", "code"}};
constexpr AttributePair kMaxFailures[] = {{"max_failures", "failure_count", Conversions::Children}};
constexpr AttributePair kVariable[] = {{"variable", "on", Conversions::WithoutBraces}};
constexpr AttributePair kWaitDuration[] = {{"wait_duration", "seconds"}};

constexpr Difference kKeepsPlace[] = {
    {"for BehaviorTree.CPP, it resumes with the child that failed, or was halted, when it is "
     "ticked again; in lockstep's language it begins with the first child"}};
constexpr Difference kRounds[] = {
    {"for BehaviorTree.CPP, a round that ends at once is followed by the next one in the same "
     "period; in lockstep's language each round takes a tick"}};
constexpr Difference kDecides[] = {
    {"for BehaviorTree.CPP, it decides after each child; in lockstep's language when all were "
     "ticked, and conditions are evaluated in every tick"}};
constexpr Difference kStands[] = {
    {"while it is held, the time of a Wait stops; that of a Sleep continues", When::IsHeld}};
constexpr Difference kSkipped = {
    "for BehaviorTree.CPP, a condition that is skipped is an error; in lockstep's language the "
    "node is skipped then",
    When::FirstIsSkipped};
constexpr Difference kLeafSkips = {
    "for BehaviorTree.CPP, it is an error that a leaf skips the condition by returning Skipped; in "
    "lockstep's language the node is skipped then",
    When::LeafSkipsFirst};
constexpr Difference kBranches[] = {kSkipped, kLeafSkips};
constexpr Difference kAsks[] = {
    {"for BehaviorTree.CPP, an action that is the condition keeps its result, and a condition that "
     "runs does not halt the branch; in lockstep's language the action begins again in the next "
     "tick, and the branch is halted",
     When::ConditionRuns},
    {"for BehaviorTree.CPP, it matters whether a leaf that is the condition, or in it, is an "
     "action: "
     "it may keep its result, or run next to the branch; in lockstep's language it begins again in "
     "the next tick, and the branch is halted while it runs",
     When::LeafMayRun},
    {"for BehaviorTree.CPP, a script that decides the condition runs once in an activation, and "
     "then the condition itself decides; in lockstep's language the script runs in every tick",
     When::FirstIsDecided},
    kSkipped,
    kLeafSkips};
constexpr std::string_view kAfterSkip =
    "for BehaviorTree.CPP, the time continues after the child was skipped; in lockstep's language "
    "it begins again";
constexpr Difference kTime[] = {{kAfterSkip, When::FirstIsSkipped},
                                {kAfterSkip, When::LeafSkipsFirst}};

constexpr std::string_view kOneEach =
    "one attempt in each tick; without a limit: a <Repeat> between two <Inverter>";
constexpr std::string_view kFirstResult = "after that it returns the first result";
constexpr std::string_view kAgain = "after a Failure it begins with the first child";
constexpr std::string_view kCaseList = "its cases are one list: cases=\"dock;drive\"";
constexpr std::string_view kTry =
    "write <Fallback memory=\"true\"> of a Sequence of the others and <ForceFailure> of the last";
constexpr std::string_view kAsk = "put a <Check> before it, in a Sequence";
constexpr std::string_view kAskNot = "put a condition before it, in a Fallback";
constexpr std::string_view kCompare = "write <Check code=\"key == 'value'\"/>";
constexpr std::string_view kNoQueues = "there are no queues: let a leaf take the next item";
constexpr std::string_view kStart =
    "give the entry a start value with --set, or as an attribute of the SubTree";
constexpr std::string_view kWriter =
    "let the leaf that writes the entry set a flag in another entry";
constexpr std::string_view kModel =
    "delete it: ports come from the plugin, and `lockstep nodes` lists them";

constexpr NodePair kPairs[] = {
    {.theirs = "Sequence", .ours = "Sequence", .in_ours = kRemembers},
    {.theirs = "Fallback", .ours = "Fallback", .in_ours = kRemembers},
    {.theirs = "ReactiveSequence", .ours = "Sequence", .in_ours = kForgets},
    {.theirs = "ReactiveFallback", .ours = "Fallback", .in_ours = kForgets},
    {.theirs = "SequenceWithMemory",
     .ours = "Sequence",
     .in_ours = kRemembers,
     .differences = kKeepsPlace,
     .remark = kAgain},
    {.theirs = "ParallelAbsolute", .ours = "ParallelAbsolute"},
    {.theirs = "ParallelRelative", .ours = "ParallelRelative"},
    {.theirs = "Parallel",
     .ours = "Parallel",
     .in_ours = kKeepsResults,
     .attributes = kCounts,
     .differences = kDecides,
     .remark = "counts are 1 or more"},
    {.theirs = "Repeat",
     .ours = "Repeat",
     .attributes = kCycles,
     .differences = kRounds,
     .remark = "one iteration in each tick"},
    {.theirs = "RetryUntilSuccessful",
     .ours = "Retry",
     .attributes = kAttempts,
     .differences = kRounds,
     .remark = kOneEach},
    {.theirs = "Inverter", .ours = "Inverter"},
    {.theirs = "ForceSuccess", .ours = "ForceSuccess"},
    {.theirs = "ForceFailure", .ours = "ForceFailure"},
    {.theirs = "KeepRunningUntilFailure", .ours = "KeepRunningUntilFailure"},
    {.theirs = "RunOnce",
     .ours = "RunOnce",
     .in_theirs = kRepeatsResult,
     .words = kThenSkip,
     .remark = kFirstResult},
    {.theirs = "Timeout",
     .ours = "Timeout",
     .in_ours = kWallClock,
     .attributes = kMsec,
     .differences = kTime},
    {.theirs = "Delay",
     .ours = "Delay",
     .in_ours = kWallClock,
     .attributes = kDelayMsec,
     .differences = kTime},
    {.theirs = "Sleep", .ours = "Wait", .attributes = kMsec, .differences = kStands},
    {.theirs = "SubTree", .ours = "SubTree", .words = kSubTreeWords},
    {.theirs = "IfThenElse", .ours = "IfThenElse", .differences = kBranches},
    {.theirs = "WhileDoElse", .ours = "WhileDoElse", .differences = kAsks},
    {.theirs = "Script", .ours = "Script"},
    {.theirs = "WaitUntil", .ours = "WaitUntil"},
    {.theirs = "SyncProgress", .ours = "SyncProgress"},
    {.theirs = "InStep", .ours = "InStep"},
    {.theirs = "UseResources", .ours = "UseResources"},
    {.theirs = "ScriptCondition", .ours = "Check", .words = kCode},
    {.theirs = "AlwaysSuccess", .ours = "AlwaysSuccess"},
    {.theirs = "AlwaysFailure", .ours = "AlwaysFailure"},
};

// A Switch is converted too, by author/convert/switch_node.h.
constexpr NodePair kSimilar[] = {
    {.theirs = "AsyncSequence", .ours = "Sequence", .in_ours = kRemembers},
    {.theirs = "AsyncFallback", .ours = "Fallback", .in_ours = kRemembers},
    {.theirs = "ParallelAll",
     .ours = "Parallel",
     .words = kMaxFailures,
     .remark = "it ends with the decisive failure"},
    {.theirs = "Switch2", .ours = "Switch", .words = kVariable, .remark = kCaseList},
    {.theirs = "Switch3", .ours = "Switch", .words = kVariable, .remark = kCaseList},
    {.theirs = "Switch4", .ours = "Switch", .words = kVariable, .remark = kCaseList},
    {.theirs = "Switch5", .ours = "Switch", .words = kVariable, .remark = kCaseList},
    {.theirs = "Switch6", .ours = "Switch", .words = kVariable, .remark = kCaseList},
    {.theirs = "TryCatch", .remark = kTry},
    {.theirs = "Precondition", .remark = kAsk},
    {.theirs = "WaitValueUpdate", .remark = "put a leaf that waits before it, in a Sequence"},
    {.theirs = "SkipUnlessUpdated", .remark = kAskNot},
    {.theirs = "LoopInt", .remark = kNoQueues},
    {.theirs = "LoopBool", .remark = kNoQueues},
    {.theirs = "LoopDouble", .remark = kNoQueues},
    {.theirs = "LoopString", .remark = kNoQueues},
    {.theirs = "BlackboardCheckInt", .remark = kCompare},
    {.theirs = "BlackboardCheckDouble", .remark = kCompare},
    {.theirs = "BlackboardCheckBool", .remark = kCompare},
    {.theirs = "BlackboardCheckString", .remark = kCompare},
    {.theirs = "SetBlackboard", .remark = kStart},
    {.theirs = "UnsetBlackboard", .remark = kWriter},
    {.theirs = "WasEntryUpdated", .remark = kWriter},
    {.theirs = "TreeNodeModel", .remark = kModel},
    // The nodes of Nav2.
    {.theirs = "RecoveryNode", .remark = kOfNav},
    {.theirs = "PipelineSequence", .remark = kOfNav},
    {.theirs = "RoundRobin", .remark = kOfNav},
    {.theirs = "RateController", .remark = kOfNav},
    {.theirs = "SpeedController", .remark = kOfNav},
    {.theirs = "DistanceController", .remark = kOfNav},
    {.theirs = "GoalUpdatedController", .remark = kOfNav},
    {.theirs = "GoalUpdated", .remark = kOfNav},
    {.theirs = "GlobalUpdatedGoal", .remark = kOfNav},
    {.theirs = "PathExpiringTimer", .remark = kOfNav},
    {.theirs = "NonblockingSequence",
     .ours = "Parallel",
     .remark = "actions that succeeded are not ticked again"},
    {.theirs = "PersistentSequence",
     .ours = "Sequence",
     .in_ours = kRemembers,
     .remark = "its place is not on the blackboard"},
    {.theirs = "SingleTrigger", .ours = "RunOnce", .remark = kFirstResult},
    {.theirs = "PathLongerOnApproach", .remark = kAskNot},
    {.theirs = "Wait", .ours = "Wait", .words = kWaitDuration},
};

}  // namespace

std::span<const NodePair> node_pairs() {
  return kPairs;
}

std::span<const NodePair> similar_nodes() {
  return kSimilar;
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
      return "only a positive number can; a Repeat between two Inverters tries without limit";
    default:
      return "only a number of children from 1 on can";
  }
}

}  // namespace lockstep::host::btcpp
