#include "scenario/ended_results.h"

#include <map>
#include <string>

namespace lockstep::host {

EndedResults::EndedResults(const RecordingHeader& header, const Tree& tree)
    : never_runs_(header.nodes.size()), children_(header.nodes.size()) {
  std::map<std::string, const NodeType*> types;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    types[tree.path(node)] = tree.labels[node].type;
  }
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const ShapeNode& it = header.nodes[node];
    const auto found = types.find(it.path);
    const NodeType* const type = found == types.end() ? nullptr : found->second;
    parents_.push_back(it.parent);
    rules_.push_back(rule_of(type));
    never_runs_[node] = type != nullptr && !type->can_run;
    if (it.parent) children_[*it.parent].push_back(node);
  }
  for (NodeIndex node = static_cast<NodeIndex>(header.nodes.size()); node-- > 0;) {
    const bool may_run = !never_runs_[node];
    if (may_run && parents_[node]) never_runs_[*parents_[node]] = false;
  }
}

EndedResults::Rule EndedResults::rule_of(const NodeType* type) {
  if (type == nullptr) return Rule::Other;
  if (type->goes_on_after == Status::Success) return Rule::AllOf;
  if (type->goes_on_after == Status::Failure) return Rule::OneOf;
  if (type->inverts) return Rule::Opposite;
  if (type->has_branches) return Rule::Choice;
  if (type->repeats_after == Status::Failure) return Rule::Retries;
  return Rule::Other;
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
  const bool is_last = is_last_ticked(tick, parent, node);
  if (rule == Rule::Choice && !is_last && node == children_[parent].front()) {
    return tick.nodes[children_[parent][1]].ticked ? Status::Success : Status::Failure;
  }
  const Status above = of(tick, parent);
  if (above == Status::Skipped) return Status::Skipped;
  if (tick.nodes[parent].status != Status::Idle) {
    // These do not halt what they have ticked.
    return is_ordered ? Status::Skipped : Status::Running;
  }
  switch (rule) {
    case Rule::AllOf:
      return is_last ? above : Status::Success;
    case Rule::OneOf:
      return is_last ? above : Status::Failure;
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
