// The scripts around the ticks of a node, and how any script runs.
#include <utility>

#include "core/conversion.h"
#include "engine/node_context.h"

namespace lockstep {
Status NodeContext::tick_hooked(NodeIndex node) {
  const HookedNode& hooked = tree_.hooked[tree_.hooks[node]];
  const bool begins = first_tick(node);
  auto decided = begins && hooked.begins ? ask_first(node, hooked) : std::nullopt;
  if (!decided && hooked.script(Hook::While) != HookedNode::kNoScript) {
    decided = ask_while(node, hooked);
  }
  const auto note = hooked.kind->decided;
  if (decided && begins && note != nullptr) note(*this, node, *decided);
  const Status status = decided ? *decided : hooked.kind->tick(*this, node);
  return hooked.ends ? finish(node, hooked, status) : status;
}

inline Truth NodeContext::ask(NodeIndex node, const HookedNode& hooked, Hook hook) {
  const Truth answer = scripts_.test(node, hooked.script(hook));
  if (answer == Truth::Error) [[unlikely]] {
    fail_script(node, attribute_of(hook, *tree_.rules), scripts_.error());
  }
  return answer;
}

// The result without a tick, if a script gives it.
std::optional<Status> NodeContext::ask_first(NodeIndex node, const HookedNode& hooked) {
  static constexpr std::pair<Hook, Status> kFirst[] = {{Hook::FailureIf, Status::Failure},
                                                       {Hook::SuccessIf, Status::Success},
                                                       {Hook::SkipIf, Status::Skipped}};
#pragma GCC unroll 3
  for (const auto& [hook, result] : kFirst) {
    if (hooked.script(hook) == HookedNode::kNoScript) continue;
    const Truth answer = ask(node, hooked, hook);
    if (answer != Truth::No) return answer == Truth::Yes ? result : Status::Failure;
  }
  return std::nullopt;
}

std::optional<Status> NodeContext::ask_while(NodeIndex node, const HookedNode& hooked) {
  const bool runs = status(node) == Status::Running;
  const Truth goes_on = ask(node, hooked, Hook::While);
  if (goes_on == Truth::Yes) return std::nullopt;
  if (goes_on == Truth::Error) return Status::Failure;
  if (runs) halt(node);
  // If that was a fault, the node counts as running until the end of the run, which is to come.
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).started = false;
  return Status::Skipped;
}

// The scripts after the last tick.
Status NodeContext::finish(NodeIndex node, const HookedNode& hooked, Status status) {
  if (!is_complete(status) || state_.faulted) return status;
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).started = false;  // nothing to halt
  const Hook first = status == Status::Success ? Hook::OnSuccess : Hook::OnFailure;
  for (const Hook hook : {first, Hook::Post}) {
    const std::uint32_t script = hooked.script(hook);
    if (script == HookedNode::kNoScript || scripts_.evaluate(node, script)) continue;
    fail_script(node, attribute_of(hook, *tree_.rules), scripts_.error());
    return Status::Failure;
  }
  return status;
}

Status NodeContext::tick_unreset(NodeIndex node) {
  if (state_.faulted) return Status::Running;
  const Node& it = tree_.nodes[node];
  const bool hooked = !tree_.hooks.empty() && tree_.hooks[node] != HookedNode::kNoScript;
  const HookedNode* const hooks = hooked ? &tree_.hooked[tree_.hooks[node]] : nullptr;
  const NodeKind& kind = hooked ? *hooks->kind : *it.kind;
  const Unreset how =
      kind.unreset != nullptr ? kind.unreset(*this, node) : unreset_by(*tree_.labels[node].type);
  Status result = status(node);
  if (how != Unreset::KeepsResult) {
    if (it.children != 0) forget_descendants(node);
    state_.activity[node] = how == Unreset::GoesOn ? Activity::Running : Activity::Idle;
    result = kind.tick(*this, node);
  }
  if (hooked) result = finish(node, *hooks, result);
  if (state_.faulted) result = Status::Running;
  state_.activity[node] = static_cast<Activity>(result);
  state_.last_tick[node] = state_.tick_number;
  return result;
}

void NodeContext::note_halt(NodeIndex node) {
  const std::uint32_t hooks = tree_.hooks[node];
  if (hooks == HookedNode::kNoScript) return;
  if (tree_.hooked[hooks].script(Hook::OnHalted) != HookedNode::kNoScript) {
    halting_.push_back(node);
  }
}

// Of those noted since there were `from`, and whose subtree ends before the next node.
void NodeContext::run_halt_hooks(std::size_t from, NodeIndex next) {
  while (halting_.size() > from && tree_.nodes[halting_.back()].end <= next) {
    const NodeIndex node = halting_.back();
    halting_.pop_back();
    run_script(node, tree_.hooked[tree_.hooks[node]].script(Hook::OnHalted),
               attribute_of(Hook::OnHalted, *tree_.rules));
  }
}

bool NodeContext::run_script(NodeIndex node, std::uint32_t script, std::string_view attribute) {
  if (script == HookedNode::kNoScript) return true;
  if (scripts_.evaluate(node, script)) return true;
  fail_script(node, attribute, scripts_.error());
  return false;
}

const Value* NodeContext::result_of(NodeIndex node, std::uint32_t script,
                                    std::string_view attribute) {
  if (!run_script(node, script, attribute)) return nullptr;
  if (!std::holds_alternative<NoValue>(scripts_.value())) return &scripts_.value();
  fail_script(node, attribute, "it has no value");
  return nullptr;
}

std::optional<bool> NodeContext::holds(NodeIndex node, std::uint32_t script,
                                       std::string_view attribute) {
  const Truth answer = scripts_.test(node, script);
  if (answer != Truth::Error) return answer == Truth::Yes;
  fail_script(node, attribute, scripts_.error());
  return std::nullopt;
}

// Under FaultPolicy::Fail the node fails, whatever it is; what runs in it is halted.
void NodeContext::fail_script(NodeIndex node, std::string_view attribute, std::string_view wrong) {
  std::string message = "its ";
  set_fault(node, message.append(attribute).append(": ").append(wrong));
  if (state_.faulted) return;
  halt(node);
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).failed = false;
}

const Value* NodeContext::port_value(NodeIndex node, unsigned index) const {
  const PortBinding& it = port(node, index);
  if (it.slot != PortBinding::kUnbound) {
    const Entry& entry = board_.entries[it.slot];
    if (entry.is_present && !std::holds_alternative<NoValue>(entry.value)) return &entry.value;
  }
  return it.constant != PortBinding::kUnbound ? &tree_.constants[it.constant] : nullptr;
}

std::optional<Entry*> NodeContext::named_entry(NodeIndex node, unsigned index) {
  const PortBinding& it = port(node, index);
  if (it.slot == PortBinding::kUnbound) return nullptr;
  Entry& entry = board_.entries[it.slot];
  if (it.constant != PortBinding::kUnbound) return &entry;  // its name is in the tree
  const Parameter& parameter = tree_.labels[node].type->parameters[index];
  const auto name =
      entry.is_present ? convert_value(entry.value, ValueType::String, nullptr) : std::nullopt;
  if (!name) {
    std::string message = "'";
    message.append(parameter.name).append("' has no value: nothing has written the entry '{");
    set_fault(node, message.append(tree_.slots[it.slot].name).append("}'"));
    return std::nullopt;
  }
  const std::uint32_t board = tree_.board_of(node);
  const auto& key = std::get<std::string>(*name);
  return parameter.own_only ? names_.own(board, key) : &names_.at(board, key);
}

}  // namespace lockstep
