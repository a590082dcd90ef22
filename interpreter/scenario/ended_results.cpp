#include "scenario/ended_results.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace lockstep::host {

struct EndedResults::Kind {
  std::string_view name;
  Rule rule;
  bool may_run = true;  // also where none of its children does
};

EndedResults::EndedResults(const RecordingHeader& header, const std::vector<bool>& conditions)
    : never_runs_(conditions), children_(header.nodes.size()) {
  std::vector<bool> may_run(header.nodes.size());
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const RecordedNode& it = header.nodes[node];
    const Kind& kind = kind_of(it.kind);
    parents_.push_back(it.parent);
    rules_.push_back(kind.rule);
    may_run[node] = kind.may_run;
    if (it.parent) children_[*it.parent].push_back(node);
  }
  for (NodeIndex node = static_cast<NodeIndex>(header.nodes.size()); node-- > 0;) {
    if (children_[node].empty() || may_run[node]) continue;
    never_runs_[node] =
        std::ranges::all_of(children_[node], [&](NodeIndex child) { return never_runs_[child]; });
  }
}

const EndedResults::Kind& EndedResults::kind_of(const std::string& name) {
  static constexpr Kind kKinds[] = {
      {"Sequence", Rule::AllOf, false},
      {"ReactiveSequence", Rule::AllOf, false},
      {"SequenceWithMemory", Rule::AllOf, false},
      {"AsyncSequence", Rule::AllOf},
      {"Fallback", Rule::OneOf, false},
      {"ReactiveFallback", Rule::OneOf, false},
      {"AsyncFallback", Rule::OneOf},
      {"IfThenElse", Rule::Choice, false},
      {"WhileDoElse", Rule::Choice, false},
      {"Inverter", Rule::Opposite, false},
      {"Retry", Rule::Retries},
      {"RetryUntilSuccessful", Rule::Retries},
      {"Repeat", Rule::Repeats},
      {"KeepRunningUntilFailure", Rule::Repeats},
      {"Check", Rule::Other, false},
      {"Parallel", Rule::Other, false},
      {"ForceSuccess", Rule::Other, false},
      {"ForceFailure", Rule::Other, false},
      {"SubTree", Rule::Other, false},
      {"", Rule::Other},
  };
  const auto found = std::ranges::find(kKinds, name, &Kind::name);
  return found == std::end(kKinds) ? *std::prev(std::end(kKinds)) : *found;
}

Status EndedResults::of(const RecordedTick& tick, NodeIndex node) const {
  const RecordedState& state = tick.nodes[node];
  if (state.status != Status::Idle || !state.ticked || !parents_[node]) return state.status;
  const Status status = below(tick, *parents_[node], node);
  if (status != Status::Running || !never_runs_[node]) return status;
  return result_in(*parents_[node], node);
}

// Of what is never running, and the last that was ticked: all around it went on.
Status EndedResults::result_in(NodeIndex parent, NodeIndex node) const {
  const bool fails = rules_[parent] == Rule::Retries ||
                     (rules_[parent] == Rule::AllOf && node != children_[parent].back());
  return fails ? Status::Failure : Status::Success;
}

Status EndedResults::below(const RecordedTick& tick, NodeIndex parent, NodeIndex node) const {
  const Rule rule = rules_[parent];
  const bool is_ordered = rule == Rule::AllOf || rule == Rule::OneOf;
  const Status above = of(tick, parent);
  if (above == Status::Skipped) return Status::Skipped;
  if (tick.nodes[parent].status != Status::Idle) {
    // These do not halt what they have ticked.
    return is_ordered ? Status::Skipped : Status::Running;
  }
  const bool is_last = is_last_ticked(tick, parent, node);
  switch (rule) {
    case Rule::AllOf:
      return is_last ? above : Status::Success;
    case Rule::OneOf:
      return is_last ? above : Status::Failure;
    case Rule::Choice:
      if (is_last || node != children_[parent].front()) return above;
      return tick.nodes[children_[parent][1]].ticked ? Status::Success : Status::Failure;
    case Rule::Opposite:
      if (above == Status::Running) return above;
      return above == Status::Success ? Status::Failure : Status::Success;
    default:
      return above;
  }
}

bool EndedResults::is_last_ticked(const RecordedTick& tick, NodeIndex parent,
                                  NodeIndex node) const {
  bool is_last = true;
  for (const NodeIndex it : children_[parent]) {
    if (it > node && tick.nodes[it].ticked) is_last = false;
  }
  return is_last;
}

}  // namespace lockstep::host
