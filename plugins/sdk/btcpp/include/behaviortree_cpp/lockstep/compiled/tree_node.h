// The functions of tree_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT {
LOCKSTEP_BTCPP_INLINE TreeNode::TreeNode(std::string name, NodeConfig config)
    : lockstep_name_(std::move(name)),
      lockstep_config_(std::move(config)),
      lockstep_place_(std::exchange(lockstep_detail::creating, nullptr)) {}

LOCKSTEP_BTCPP_INLINE NodeStatus TreeNode::executeTick() {
  return lockstep_tick_as([this] { return tick(); });
}

[[gnu::cold, gnu::noinline]] LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_refuse(
    const char* what) const {
  throw LogicError("node '", lockstep_name_, "' ", what);
}

[[gnu::cold, gnu::noinline]] LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_refuse_idle() const {
  lockstep_refuse("has returned IDLE, which is no result of a tick");
}

LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_note(NodeStatus status) {
  if (status != NodeStatus::SKIPPED) {
    setStatus(status);
  } else if (lockstep_place_ != nullptr || type() == NodeType::ACTION ||
             type() == NodeType::CONDITION) {
    setStatus(NodeStatus::IDLE);
  }  // by hand, a node with children keeps its status: its parent halts it, and so them
}

[[gnu::noinline]] LOCKSTEP_BTCPP_INLINE NodeStatus TreeNode::lockstep_noted(NodeStatus status) {
  if (status == NodeStatus::IDLE) lockstep_refuse_idle();
  lockstep_note(status);
  return status;
}

[[gnu::cold]] LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_rethrow(
    const std::exception& thrown) const {
  const bool is_told = dynamic_cast<const NodeExecutionError*>(&thrown) != nullptr;
  if (lockstep_place_ != nullptr || is_told) throw;
  const std::string& path = fullPath().empty() ? lockstep_name_ : fullPath();
  throw NodeExecutionError({lockstep_name_, path, lockstep_registration_name_}, thrown.what());
}

LOCKSTEP_BTCPP_INLINE double TreeNode::lockstep_seconds() const {
  if (lockstep_place_ != nullptr) return lockstep_place_->host->now(lockstep_place_->caller);
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

[[gnu::noinline]] LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_tell(NodeStatus status) {
  const NodeStatus before = lockstep_status_.exchange(status, std::memory_order_acq_rel);
  if (before == status) return;
  lockstep_watch_->changes.notify(std::chrono::high_resolution_clock::now(), *this, before, status);
}

LOCKSTEP_BTCPP_INLINE NodeStatus
TreeNode::lockstep_watched_tick(const std::function<NodeStatus()>& work) {
  NodeStatus status = NodeStatus::IDLE;
  if (lockstep_watch_->before && !isStatusCompleted(this->status()))
    status = lockstep_watch_->before(*this);
  if (!isStatusCompleted(status)) {
    const auto began = std::chrono::steady_clock::now();
    status = work();
    const auto took = std::chrono::steady_clock::now() - began;
    if (lockstep_watch_->monitor) {
      lockstep_watch_->monitor(*this, status,
                               std::chrono::duration_cast<std::chrono::microseconds>(took));
    }
  }
  if (lockstep_watch_->after) {
    const NodeStatus decided = lockstep_watch_->after(*this, status);
    if (isStatusCompleted(decided)) status = decided;
  }
  return status;
}

LOCKSTEP_BTCPP_INLINE void TreeNode::emitWakeUpSignal() {
  if (lockstep_wake_up_ != nullptr) lockstep_wake_up_->emitSignal();
  if (lockstep_place_ == nullptr) return;  // nobody ticks it
  if (lockstep_place_->is_in_tick()) {
    lockstep_place_->node->ask_for_tick(lockstep_place_->caller);
  } else {
    lockstep_place_->wake();
  }
}

LOCKSTEP_BTCPP_INLINE std::string TreeNode::lockstep_no_port(StringView port) const {
  return StrCat("'", lockstep_registration_name_, "' has no port '", port,
                "': list it in its providedPorts()");
}

LOCKSTEP_BTCPP_INLINE Expected<Any> TreeNode::lockstep_read_any(
    const lockstep_detail::PortEntry& port) const {
  Any value;
  if (port.info.lockstep_values().get(*lockstep_place_, port.index, value)) return value;
  return lockstep_read_other<Any>(port);
}

// A node that is in no tree reads and writes the entries of its blackboard, from any thread.
LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_begin_thread() {
  if (lockstep_place_ == nullptr) return;
  lockstep_thread_ = std::make_unique<LockstepThreadPorts>();
  for (const lockstep_detail::PortEntry& port : lockstep_place_->registration->ports) {
    lockstep_thread_->inputs.push_back(lockstep_read_any(port));
  }
}

LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_end_thread() {
  const auto ports = std::move(lockstep_thread_);
  if (ports == nullptr) return;
  for (const auto& [port, value] : ports->outputs) {
    const lockstep_detail::PortValues& values = port->info.lockstep_values();
    values.set(*lockstep_place_, port->index,
               value.isString() && values.type != LOCKSTEP_STRING && values.type != LOCKSTEP_ANY
                   ? values.parse(value.cast<std::string>())
                   : value);
  }
}

LOCKSTEP_BTCPP_INLINE Blackboard::LockstepPort TreeNode::lockstep_entry_of(
    const std::string& port) const {
  if (lockstep_place_ != nullptr) {
    const lockstep_detail::PortEntry* const it = lockstep_find_port(port);
    if (it == nullptr) return {};
    return Blackboard::lockstep_of_port(*lockstep_place_, it->index);
  }
  std::string given;
  for (const PortsRemapping* ports :
       {&lockstep_config_.input_ports, &lockstep_config_.output_ports}) {
    if (const auto found = ports->find(port); found != ports->end()) given = found->second;
  }
  if (const TreeNodeManifest* const it = lockstep_config_.manifest;
      given.empty() && it != nullptr) {
    const auto declared = it->ports.find(port);
    if (declared != it->ports.end()) given = declared->second.defaultValueString();
  }
  const auto key = getRemappedKey(port, given);
  if (!key) return {};
  return {lockstep_config_.blackboard, std::string(*key)};
}

LOCKSTEP_BTCPP_INLINE Timestamp TreeNode::lockstep_stamp_of(const std::string& port) const {
  const auto it = lockstep_entry_of(port);
  const auto entry = it.board == nullptr ? nullptr : it.board->lockstep_find(it.key).entry;
  if (entry == nullptr) return {};
  const std::lock_guard lock(entry->entry_mutex);
  return {entry->sequence_id, entry->stamp};
}

LOCKSTEP_BTCPP_INLINE AnyPtrLocked TreeNode::lockstep_locked_port(const std::string& port) {
  const auto it = lockstep_entry_of(port);
  if (it.board == nullptr) return {};
  auto found = it.board->lockstep_find(it.key);
  if (found.entry == nullptr) {
    it.board->lockstep_create(it.key, {});
    found = it.board->lockstep_find(it.key);
  }
  return Blackboard::lockstep_locked(std::move(found));
}

LOCKSTEP_BTCPP_INLINE Result TreeNode::lockstep_set_by_hand(const std::string& port, Any value,
                                                            TypeInfo type) {
  const auto found = lockstep_config_.output_ports.find(port);
  if (lockstep_config_.blackboard == nullptr) {
    return nonstd::make_unexpected(
        StrCat("setOutput: the NodeConfig of '", lockstep_name_, "' has no blackboard"));
  }
  if (found == lockstep_config_.output_ports.end()) {
    return nonstd::make_unexpected(StrCat("'", lockstep_name_, "' has no entry for the port '",
                                          port, "': put one into NodeConfig::output_ports"));
  }
  const auto key = getRemappedKey(port, found->second);
  if (!key) {
    return nonstd::make_unexpected(
        StrCat("port '", port, "' is bound to no entry; write ", port, "=\"{key}\""));
  }
  lockstep_config_.blackboard->lockstep_set(std::string(*key), std::move(value), std::move(type));
  return std::monostate{};
}

LOCKSTEP_BTCPP_INLINE StringView TreeNode::getRawPortValue(const std::string& port) const {
  for (const PortsRemapping* ports :
       {&lockstep_config_.input_ports, &lockstep_config_.output_ports}) {
    if (const auto found = ports->find(port); found != ports->end()) return found->second;
  }
  throw LogicError("[", port, "] is no port of '", lockstep_name_, "'");
}

LOCKSTEP_BTCPP_INLINE bool TreeNode::isBlackboardPointer(StringView text, StringView* stripped) {
  constexpr StringView kBlanks = " \t\n\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == StringView::npos) return false;
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.size() < 3 || text.front() != '{' || text.back() != '}') return false;
  if (stripped != nullptr) *stripped = text.substr(1, text.size() - 2);
  return true;
}

LOCKSTEP_BTCPP_INLINE StringView TreeNode::stripBlackboardPointer(StringView text) {
  StringView key;
  return isBlackboardPointer(text, &key) ? key : StringView();
}

LOCKSTEP_BTCPP_INLINE Expected<StringView> TreeNode::getRemappedKey(StringView port,
                                                                    StringView given) {
  StringView key;
  if (given == "{=}" || given == "=") return port;
  if (isBlackboardPointer(given, &key)) return key;
  return nonstd::make_unexpected(std::string("it is no entry"));
}

LOCKSTEP_BTCPP_INLINE TreeNode::~TreeNode() = default;

LOCKSTEP_BTCPP_INLINE TreeNode::LockstepWatch& TreeNode::lockstep_watch() {
  if (lockstep_watch_ == nullptr) lockstep_watch_ = std::make_unique<LockstepWatch>();
  if (lockstep_tree_ != nullptr) lockstep_tree_->begin_watch();
  return *lockstep_watch_;
}
LOCKSTEP_BTCPP_INLINE void TreeNode::setPreTickFunction(PreTickCallback call) {
  lockstep_watch().before = std::move(call);
}
LOCKSTEP_BTCPP_INLINE void TreeNode::setPostTickFunction(PostTickCallback call) {
  lockstep_watch().after = std::move(call);
}
LOCKSTEP_BTCPP_INLINE void TreeNode::setTickMonitorCallback(TickMonitorCallback call) {
  lockstep_watch().monitor = std::move(call);
}
LOCKSTEP_BTCPP_INLINE TreeNode::StatusChangeSubscriber TreeNode::subscribeToStatusChange(
    StatusChangeCallback call) {
  return lockstep_watch().changes.subscribe(std::move(call));
}
LOCKSTEP_BTCPP_INLINE void TreeNode::lockstep_visit(
    const std::function<void(TreeNode*, std::size_t)>& visitor, std::size_t depth) {
  visitor(this, depth);
}

}  // namespace BT
