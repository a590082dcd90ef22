#include "definition/foreign_nodes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/audience.h"
#include "core/value.h"
#include "core/wording.h"

namespace lockstep {
namespace {

using enum ForeignValue;

constexpr ForeignAttribute kRepeat[] = {{"num_cycles", "times", OrEndless}};
constexpr ForeignAttribute kRetry[] = {{"num_attempts", "attempts", FromOne}};
constexpr ForeignAttribute kMsec[] = {{"msec", "seconds", Milliseconds}};
constexpr ForeignAttribute kDelay[] = {{"delay_msec", "seconds", Milliseconds}};
constexpr ForeignAttribute kWait[] = {{"wait_duration", "seconds"}};
constexpr ForeignAttribute kRunOnce[] = {{"then_skip", ""}};
constexpr ForeignAttribute kParallel[] = {{"success_threshold", "success_count", FromOne},
                                          {"threshold", "success_count", FromOne},
                                          {"failure_threshold", "failure_count", FromOne}};
constexpr ForeignAttribute kParallelAll[] = {{"max_failures", "failure_count", FromOne}};
constexpr ForeignAttribute kSubTree[] = {
    {"ID", "ID"}, {"__autoremap", "_autoremap"}, {"__shared_blackboard", "_autoremap"}};
constexpr ForeignAttribute kSwitch[] = {{"variable", "on", WithoutBraces}};
constexpr ForeignAttribute kCheck[] = {{"code", "code"}};
constexpr ForeignAttribute kScripts[] = {{"_skipIf", "skip_if"},       {"_successIf", "success_if"},
                                         {"_failureIf", "failure_if"}, {"_while", "while"},
                                         {"_onHalted", "on_halt"},     {"_onFailure", "on_failure"},
                                         {"_onSuccess", "on_success"}, {"_post", "on_end"}};
constexpr ForeignAttribute kMarks[] = {{"_uid", ""},        {"_fullpath", ""},  {"_collapsed", ""},
                                       {"_favorite", ""},   {"_hardcoded", ""}, {"_external", ""},
                                       {"_subtreeOnly", ""}};

constexpr std::string_view kAgain = "after a Failure it begins with the first child";
constexpr std::string_view kCases = "its cases are one list: cases=\"dock;drive\"";
constexpr std::string_view kTry =
    "write <Fallback memory=\"true\"> of a Sequence of the others and <ForceFailure> of the last";
constexpr std::string_view kAttempts =
    "one attempt in each tick; for ever: a <Repeat> between two <Inverter>";
constexpr std::string_view kNav = "the plugin nav has it: add <plugin name=\"nav\"/>";
constexpr std::string_view kAsk = "put a <Check> before it, in a Sequence";
constexpr std::string_view kAskNot = "put a condition before it, in a Fallback";
constexpr std::string_view kOften = "<Rate seconds=\"…\"> starts its child at most so often";
constexpr std::string_view kCompare = "write <Check code=\"key == 'value'\"/>";
constexpr std::string_view kNoQueues = "there are no queues: let a leaf take the next item";
constexpr std::string_view kStart =
    "give the entry a start value with --set, or as an attribute of the SubTree";
constexpr std::string_view kStartInProgram =
    "give the entry a start value, or one as an attribute of the SubTree";
constexpr std::string_view kWriter =
    "let the leaf that writes the entry set a flag in another entry";
constexpr std::string_view kModel =
    "delete it: ports come from the plugin, and `lockstep nodes` lists them";

constexpr ForeignNode kNodes[] = {
    {"ReactiveSequence", "Sequence"},
    {"ReactiveFallback", "Fallback"},
    {"AsyncSequence", "Sequence memory=\"true\""},
    {"AsyncFallback", "Fallback memory=\"true\""},
    {"FallbackStar", "Fallback memory=\"true\""},
    {"SequenceWithMemory", "Sequence memory=\"true\"", {}, kAgain},
    {"SequenceStar", "Sequence memory=\"true\"", {}, kAgain},
    {"Parallel", "Parallel", kParallel, "counts are 1 or more"},
    {"ParallelAll", "Parallel", kParallelAll, "it ends with the decisive failure"},
    {"Switch2", "Switch", kSwitch, kCases},
    {"Switch3", "Switch", kSwitch, kCases},
    {"Switch4", "Switch", kSwitch, kCases},
    {"Switch5", "Switch", kSwitch, kCases},
    {"Switch6", "Switch", kSwitch, kCases},
    {"TryCatch", "", {}, kTry},
    {"Repeat", "Repeat", kRepeat, "one iteration in each tick"},
    {"RetryUntilSuccessful", "Retry", kRetry, kAttempts},
    {"RetryUntilSuccesful", "Retry", kRetry, kAttempts},
    {"Timeout", "Timeout", kMsec},
    {"Delay", "Delay", kDelay},
    {"Sleep", "Wait", kMsec},
    {"RunOnce", "RunOnce", kRunOnce, "after that it returns the first result"},
    {"SubTree", "SubTree", kSubTree},
    {"SubTreePlus", "SubTree", kSubTree},
    {"Precondition", "", {}, kAsk},
    {"WaitValueUpdate", "", {}, "put a leaf that waits before it, in a Sequence"},
    {"SkipUnlessUpdated", "", {}, kAskNot},
    {"LoopInt", "", {}, kNoQueues},
    {"LoopBool", "", {}, kNoQueues},
    {"LoopDouble", "", {}, kNoQueues},
    {"LoopString", "", {}, kNoQueues},
    {"ScriptCondition", "Check", kCheck},
    {"BlackboardCheckInt", "", {}, kCompare},
    {"BlackboardCheckDouble", "", {}, kCompare},
    {"BlackboardCheckBool", "", {}, kCompare},
    {"BlackboardCheckString", "", {}, kCompare},
    {"SetBlackboard", "", {}, kStart},
    {"UnsetBlackboard", "", {}, kWriter},
    {"WasEntryUpdated", "", {}, kWriter},
    {"TreeNodeModel", "", {}, kModel},
    {"RecoveryNode", "", {}, kNav},
    {"PipelineSequence", "", {}, kNav},
    {"RoundRobin", "", {}, kNav},
    {"RateController", "", {}, kNav},
    {"NonblockingSequence", "Parallel", {}, "actions that succeeded are not ticked again"},
    {"PersistentSequence", "Sequence memory=\"true\"", {}, "its place is not on the blackboard"},
    {"SingleTrigger", "RunOnce", {}, "after that it returns the first result"},
    {"SpeedController", "", {}, kOften},
    {"DistanceController", "", {}, kOften},
    {"GoalUpdatedController", "", {}, kAskNot},
    {"PathLongerOnApproach", "", {}, kAskNot},
    {"Wait", "Wait", kWait},
    {"", "", kScripts},
    {"", "", kMarks, "a mark of an editor"},
};

const ForeignAttribute* find(std::span<const ForeignAttribute> attributes, std::string_view name) {
  const auto found = std::ranges::find(attributes, name, &ForeignAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

// If the row is that of `tag`, or of any node.
const ForeignAttribute* find_of(const ForeignNode& node, std::string_view tag,
                                std::string_view attribute) {
  return node.tag.empty() || node.tag == tag ? find(node.attributes, attribute) : nullptr;
}

// As it is written in an attribute.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : brief(text)) {
    if (c == '&') safe += "&amp;";
    if (c == '<') safe += "&lt;";
    if (c != '&' && c != '<') safe += c;
  }
  return safe;
}

// "…" if it is unknown.
std::string translated(ForeignValue kind, std::string_view text) {
  if (kind == Same) return escaped(text);
  const bool is_key = text.size() > 2 && text.front() == '{' && text.back() == '}';
  if (kind == WithoutBraces) return is_key ? escaped(text.substr(1, text.size() - 2)) : "…";
  const auto number = parse_double(text);
  const bool is_count = kind == OrEndless || kind == FromOne;
  if (!number || (is_count && *number < 1)) return "…";
  if (kind == Milliseconds) return to_text(Value(*number / 1000));
  return to_text(Value(*number));
}

// ` attempts="5"`, or "" where it is left out.
std::string translated(const ForeignAttribute& from, std::string_view text) {
  if (from.ours.empty() || (from.value == OrEndless && text == "-1")) return {};
  return fmt::format(" {}=\"{}\"", from.ours, translated(from.value, text));
}

std::string join(std::string first, std::string_view second) {
  if (first.empty() || second.empty()) return first.append(second);
  return first.append("; ").append(second);
}

}  // namespace

std::span<const ForeignNode> foreign_nodes() {
  return kNodes;
}

std::string foreign_node_hint(std::string_view tag, std::span<const Attribute> attributes) {
  const auto* const node = std::ranges::find(kNodes, tag, &ForeignNode::tag);
  if (node == std::end(kNodes) || tag.empty()) return {};
  if (node->ours.empty()) {
    return std::string(node->remark == kStart ? worded(kStart, kStartInProgram) : node->remark);
  }
  std::string start(node->ours);
  for (const Attribute& attribute : attributes) {
    if (const auto* from = find(node->attributes, attribute.name))
      start += translated(*from, attribute.value);
  }
  return join(fmt::format("write <{}>", start), node->remark);
}

std::string foreign_attribute_hint(std::string_view tag, const Attribute& attribute) {
  for (const ForeignNode& node : kNodes) {
    const auto* const from = find_of(node, tag, attribute.name);
    if (from == nullptr) continue;
    const std::string ours = translated(*from, attribute.value);
    return join(ours.empty() ? std::string("leave it out") : "write" + ours, node.remark);
  }
  return {};
}

std::string_view foreign_attribute_name(std::string_view tag, std::string_view attribute) {
  for (const ForeignNode& node : kNodes) {
    if (const auto* from = find_of(node, tag, attribute)) return from->ours;
  }
  return {};
}

}  // namespace lockstep
