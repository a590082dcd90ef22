#include "tree/check/other_tools.h"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep::host {
namespace {

// From py_trees, Unreal Engine, behavior3js, mistreevous and Groot's older palettes.
struct Word {
  std::string_view theirs;
  std::string_view ours;   // "": there is none
  std::string_view other;  // where a language has that; "": the same
  std::string_view remark = {};
};

constexpr std::string_view kNoChance =
    "no node chooses by chance, so that a run can be repeated: let a leaf choose, in front of a "
    "Switch or in a Fallback";

constexpr Word kWords[] = {
    {"Selector", "Fallback", ""},
    {"Priority", "Fallback", "ReactiveFallback"},
    {"PrioritySelector", "Fallback", "ReactiveFallback"},
    {"MemPriority", "Fallback memory=\"true\"", ""},
    {"MemSelector", "Fallback memory=\"true\"", ""},
    {"MemSequence", "Sequence memory=\"true\"", ""},
    {"All", "Parallel", "ParallelAll"},
    {"SimpleParallel", "Parallel", "ParallelAll"},
    {"Race", "Parallel success_count=\"1\"", ""},
    {"Flip", "Inverter", ""},
    {"Invert", "Inverter", ""},
    {"Not", "Inverter", ""},
    {"Succeed", "ForceSuccess", ""},
    {"Succeeder", "ForceSuccess", ""},
    {"FailureIsSuccess", "ForceSuccess", ""},
    {"Fail", "ForceFailure", ""},
    {"Failer", "ForceFailure", ""},
    {"SuccessIsFailure", "ForceFailure", ""},
    {"Repeater", "Repeat", ""},
    {"Loop", "Repeat", ""},
    {"UntilSuccess", "Retry attempts=\"…\"", "RetryUntilSuccessful num_attempts=\"-1\""},
    {"RepeatUntilSuccess", "Retry attempts=\"…\"", "RetryUntilSuccessful num_attempts=\"-1\""},
    {"UntilFail", "KeepRunningUntilFailure", ""},
    {"UntilFailure", "KeepRunningUntilFailure", ""},
    {"RepeatUntilFailure", "KeepRunningUntilFailure", ""},
    {"TimeLimit", "Timeout seconds=\"…\"", "Timeout msec=\"…\""},
    {"MaxTime", "Timeout seconds=\"…\"", "Timeout msec=\"…\""},
    {"OneShot", "RunOnce", ""},
    {"Branch", "SubTree ID=\"…\"", ""},
    {"EternalGuard", "Sequence", "ReactiveSequence", "with the condition as its first child"},
    {"Lotto", "", "", kNoChance},
    {"RandomSelector", "", "", kNoChance},
    {"RandomSequence", "", "", kNoChance},
    {"RandomFallback", "", "", kNoChance},
};

// Whether there is such a node, with the attribute that is written.
bool has(const Catalog& catalog, std::string_view node) {
  const std::string_view id = node.substr(0, node.find(' '));
  const NodeType* const type = catalog.find(id);
  if (type == nullptr) return false;
  if (id.size() == node.size() || type->category == NodeCategory::SubTree) return true;
  const std::string_view rest = node.substr(id.size() + 1);
  const std::string_view attribute = rest.substr(0, rest.find('='));
  return std::ranges::count(type->parameters, attribute, &Parameter::name) > 0;
}

}  // namespace

std::string hint_for_other_tools(std::string_view tag, const Catalog& catalog) {
  const auto* const word = std::ranges::find(kWords, tag, &Word::theirs);
  if (word == std::end(kWords)) return {};
  if (word->ours.empty()) return std::string(word->remark);
  for (const std::string_view node :
       {word->other, word->ours, word->ours.substr(0, word->ours.find(' '))}) {
    if (!has(catalog, node)) continue;
    const std::string remark = word->remark.empty() ? "" : fmt::format(", {}", word->remark);
    return fmt::format("write <{}>{}", node, remark);
  }
  return {};
}

}  // namespace lockstep::host
