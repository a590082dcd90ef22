// The scripts around the ticks of a node, and how any script runs.
#include <algorithm>
#include <utility>

#include "core/conversion.h"
#include "engine/synchronized.h"

namespace lockstep {
namespace {

// What measures see of a synchronized node that a script has decided before it began: that its
// children are all as far as it is.
void set_snapshot(Ticker& ticker, NodeIndex node, Status decided) {
  if (!compares_progress(synchronization(ticker.node(node)))) return;
  const bool succeeded = decided == Status::Success;
  std::ranges::fill(ticker.child_numbers(node), succeeded ? 1.0 : 0.0);
  ticker.state<SynchronizedState>(node).succeeded = succeeded;
}

}  // namespace

Status Ticker::tick_hooked(NodeIndex node) {
  const HookedNode& hooked = tree_.hooked[tree_.hooks[node]];
  const bool begins = first_tick(node);
  const auto decided = ask_hooks(node, hooked);
  if (decided && begins) set_snapshot(*this, node, *decided);
  return finish(node, hooked, decided ? *decided : hooked.kind->tick(*this, node));
}

// The result without a tick, if a script gives it.
std::optional<Status> Ticker::ask_hooks(NodeIndex node, const HookedNode& hooked) {
  const bool runs = status(node) == Status::Running;
  const auto ask = [&](Hook hook) {
    return holds(node, hooked.script(hook), attribute_of(hook, tree_.language));
  };
  constexpr std::pair<Hook, Status> kFirst[] = {{Hook::FailureIf, Status::Failure},
                                                {Hook::SuccessIf, Status::Success},
                                                {Hook::SkipIf, Status::Skipped}};
  for (const auto& [hook, result] : kFirst) {
    if (runs || hooked.script(hook) == HookedNode::kNoScript) continue;
    const auto is_true = ask(hook);
    if (!is_true) return Status::Failure;
    if (*is_true) return result;
  }
  if (hooked.script(Hook::While) == HookedNode::kNoScript) return std::nullopt;
  const auto goes_on = ask(Hook::While);
  if (!goes_on) return Status::Failure;
  if (*goes_on) return std::nullopt;
  if (runs) halt(node);
  // If that was a fault, the node counts as running until the end of the run, which is to come.
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).started = false;
  return Status::Skipped;
}

Status Ticker::finish(NodeIndex node, const HookedNode& hooked, Status status) {
  if (!is_complete(status) || faulted_) return status;
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).started = false;  // nothing to halt
  const Hook first = status == Status::Success ? Hook::OnSuccess : Hook::OnFailure;
  for (const Hook hook : {first, Hook::Post}) {
    const std::uint32_t script = hooked.script(hook);
    if (script == HookedNode::kNoScript) continue;
    if (!run_script(node, script, attribute_of(hook, tree_.language))) return Status::Failure;
  }
  return status;
}

Status Ticker::tick_unreset(NodeIndex node) {
  if (faulted_) return Status::Running;
  const Node& it = tree_.nodes[node];
  const bool hooked = !tree_.hooks.empty() && tree_.hooks[node] != HookedNode::kNoScript;
  const HookedNode* const hooks = hooked ? &tree_.hooked[tree_.hooks[node]] : nullptr;
  const NodeType& type = *tree_.labels[node].type;
  Status result = status(node);
  const bool takes_time = type.category == NodeCategory::Action && type.can_run;
  if (!takes_time) {
    if (it.children != 0) forget_descendants(node);
    state_.activity[node] = Activity::Idle;
    result = (hooks != nullptr ? hooks->kind : it.kind)->tick(*this, node);
  }
  if (hooks != nullptr) result = finish(node, *hooks, result);
  if (faulted_) result = Status::Running;
  state_.activity[node] = static_cast<Activity>(result);
  state_.last_tick[node] = tick_number_;
  return result;
}

void Ticker::note_halt(NodeIndex node) {
  const std::uint32_t hooks = tree_.hooks[node];
  if (hooks == HookedNode::kNoScript) return;
  if (tree_.hooked[hooks].script(Hook::OnHalted) != HookedNode::kNoScript) {
    halting_.push_back(node);
  }
}

// Of those noted since there were `from`, and whose subtree ends before the next node.
void Ticker::run_halt_hooks(std::size_t from, NodeIndex next) {
  while (halting_.size() > from && tree_.nodes[halting_.back()].end <= next) {
    const NodeIndex node = halting_.back();
    halting_.pop_back();
    run_script(node, tree_.hooked[tree_.hooks[node]].script(Hook::OnHalted),
               attribute_of(Hook::OnHalted, tree_.language));
  }
}

bool Ticker::run_script(NodeIndex node, std::uint32_t script, std::string_view attribute) {
  if (script == HookedNode::kNoScript) return true;
  std::string wrong = scripts_.evaluate(node, script);
  if (wrong.empty()) return true;
  fail_script(node, attribute, wrong);
  return false;
}

const Value* Ticker::result_of(NodeIndex node, std::uint32_t script, std::string_view attribute) {
  if (!run_script(node, script, attribute)) return nullptr;
  if (!std::holds_alternative<NoValue>(scripts_.value())) return &scripts_.value();
  fail_script(node, attribute, "it has no value");
  return nullptr;
}

std::optional<bool> Ticker::holds(NodeIndex node, std::uint32_t script,
                                  std::string_view attribute) {
  bool holds = false;
  std::string wrong = scripts_.test(node, script, holds);
  if (wrong.empty()) return holds;
  fail_script(node, attribute, wrong);
  return std::nullopt;
}

// Under FaultPolicy::Fail the node fails, whatever it is; what runs in it is halted.
void Ticker::fail_script(NodeIndex node, std::string_view attribute, std::string_view wrong) {
  std::string message = "its ";
  set_fault(node, message.append(attribute).append(": ").append(wrong));
  if (faulted_) return;
  halt(node);
  if (tree_.labels[node].type->leaf != nullptr) leaf(node).failed = false;
}

const Value* Ticker::port_value(NodeIndex node, unsigned index) const {
  const PortBinding& it = port(node, index);
  if (it.slot != PortBinding::kUnbound) {
    const Entry& entry = board_.entries[it.slot];
    if (entry.is_present && !std::holds_alternative<NoValue>(entry.value)) return &entry.value;
  }
  return it.constant != PortBinding::kUnbound ? &tree_.constants[it.constant] : nullptr;
}

std::optional<Entry*> Ticker::named_entry(NodeIndex node, unsigned index) {
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
