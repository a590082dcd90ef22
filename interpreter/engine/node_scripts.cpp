#include "engine/node_scripts.h"

#include <string>
#include <utility>

#include "engine/node_watch.h"

namespace lockstep::host {

NodeScripts::NodeScripts(NodeContext& context, const Tree& tree, Blackboard& board,
                         NamedEntries& names, Readings& readings)
    : context_(context),
      tree_(tree),
      hooks_(tree.hooks.empty() ? nullptr : tree.hooks.data()),
      hooked_(tree.hooked.data()),
      scripts_(tree, board, names, readings) {
  if (tree.has_halt_hooks) halted_.reserve(tree.hooked.size());
}

std::uint32_t NodeScripts::script(NodeIndex node, unsigned parameter) const {
  return static_cast<std::uint32_t>(context_.parameter(node, parameter).integer);
}

std::string_view NodeScripts::name(NodeIndex node, unsigned parameter) const {
  return tree_.labels[node].type->parameters[parameter].name;
}

bool NodeScripts::run(NodeIndex node, unsigned parameter) {
  const std::uint32_t it = script(node, parameter);
  if (it == HookedNode::kNoScript || scripts_.run(node, it)) return true;
  fail(node, name(node, parameter), scripts_.error());
  return false;
}

std::optional<bool> NodeScripts::holds(NodeIndex node, unsigned parameter) {
  const Truth answer = scripts_.test(node, script(node, parameter));
  if (answer != Truth::Error) return answer == Truth::Yes;
  fail(node, name(node, parameter), scripts_.error());
  return std::nullopt;
}

const Value* NodeScripts::value_of(NodeIndex node, unsigned parameter) {
  const bool ran = scripts_.evaluate(node, script(node, parameter));
  if (ran && !std::holds_alternative<NoValue>(scripts_.value())) return &scripts_.value();
  fail(node, name(node, parameter), ran ? "it has no value" : scripts_.error());
  return nullptr;
}

Status NodeScripts::tick(NodeIndex node) {
  const HookedNode& hooked = hooked_[hooks_[node]];
  const bool begins = context_.first_tick(node);
  auto decided = begins && hooked.begins ? ask_first(node, hooked) : std::nullopt;
  if (!decided && hooked.script(Hook::While) != HookedNode::kNoScript) {
    decided = ask_while(node, hooked);
  }
  const auto note = hooked.kind->decided;
  if (decided && begins && note != nullptr) note(context_, node, *decided);
  const Status status = decided ? *decided : hooked.kind->tick(context_, node);
  return hooked.ends ? finish(node, hooked, status) : status;
}

inline Truth NodeScripts::ask(NodeIndex node, const HookedNode& hooked, Hook hook) {
  const Truth answer = scripts_.test(node, hooked.script(hook));
  if (answer == Truth::Error) [[unlikely]] {
    fail(node, attribute_of(hook, *tree_.rules), scripts_.error());
  }
  return answer;
}

// The result without a tick, if a script gives it.
std::optional<Status> NodeScripts::ask_first(NodeIndex node, const HookedNode& hooked) {
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

std::optional<Status> NodeScripts::ask_while(NodeIndex node, const HookedNode& hooked) {
  const bool runs = !context_.first_tick(node);
  const Truth goes_on = ask(node, hooked, Hook::While);
  if (goes_on == Truth::Yes) return std::nullopt;
  if (goes_on == Truth::Error) return Status::Failure;
  if (runs) context_.halt(node);
  return Status::Skipped;
}

Status NodeScripts::finish(NodeIndex node, const HookedNode& hooked, Status status) {
  if (!is_complete(status) || context_.faulted()) return status;
  if (hooked.of_plugin) context_.leaf(node).set_started(false);  // nothing to halt
  const Hook first = status == Status::Success ? Hook::OnSuccess : Hook::OnFailure;
  for (const Hook hook : {first, Hook::Post}) {
    const std::uint32_t script = hooked.script(hook);
    if (script == HookedNode::kNoScript || scripts_.run(node, script)) continue;
    fail(node, attribute_of(hook, *tree_.rules), scripts_.error());
    return Status::Failure;
  }
  return status;
}

void NodeScripts::note_halt(NodeIndex node) {
  const HookedNode* const hooked = around(node);
  const bool has_script =
      hooked != nullptr && hooked->script(Hook::OnHalted) != HookedNode::kNoScript;
  const NodeWatches* const watches = context_.watches();
  const bool is_watched = watches != nullptr && watches->is_watched(node);
  if (is_watched) watches->watch()->before_halt(node);
  if (has_script || is_watched) halted_.push_back(node);
}

void NodeScripts::run_halted(std::size_t begin, NodeIndex next) {
  while (halted_.size() > begin && tree_.nodes[halted_.back()].end <= next) {
    const NodeIndex node = halted_.back();
    halted_.pop_back();
    if (!context_.is_halted_again(node)) run_halted(node);
    const NodeWatches* const watches = context_.watches();
    if (watches != nullptr && watches->is_watched(node)) watches->watch()->after_halt(node);
  }
}

void NodeScripts::run_halted(NodeIndex node) {
  const HookedNode* const hooked = around(node);
  const std::uint32_t script =
      hooked == nullptr ? HookedNode::kNoScript : hooked->script(Hook::OnHalted);
  if (script == HookedNode::kNoScript || scripts_.run(node, script)) return;
  fail(node, attribute_of(Hook::OnHalted, *tree_.rules), scripts_.error());
}

// Under FaultPolicy::Fail the node fails, whatever it is; what runs in it is halted.
void NodeScripts::fail(NodeIndex node, std::string_view attribute, std::string_view wrong) {
  std::string message = "its ";
  context_.set_fault_around(node, !context_.first_tick(node),
                            message.append(attribute).append(": ").append(wrong));
  if (!context_.faulted()) context_.halt(node);
}

}  // namespace lockstep::host
