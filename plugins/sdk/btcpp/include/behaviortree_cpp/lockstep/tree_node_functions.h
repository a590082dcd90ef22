// The functions of tree_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT {
namespace lockstep_detail {

// A value that was read before, as a T.
template <class T>
Expected<T> converted(const Expected<Any>& value,
                      const std::unordered_map<std::string, int>* enums) {
  if (!value) return nonstd::make_unexpected(value.error());
  if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, Any>) {
    if (value->isString()) return parse_with<T>(value->template cast<std::string>(), enums);
  }
  return value->template tryCast<T>();
}

// Where the node under construction finds its place, so that its class need not pass it on.
[[gnu::visibility("hidden")]] inline thread_local Place* creating = nullptr;

}  // namespace lockstep_detail

inline TreeNode::TreeNode(std::string name, NodeConfig config)
    : lockstep_name_(std::move(name)),
      lockstep_config_(std::move(config)),
      lockstep_place_(std::exchange(lockstep_detail::creating, nullptr)) {}

inline NodeStatus TreeNode::executeTick() {
  const NodeStatus status = lockstep_watch_ == nullptr ? tick() : lockstep_watched_tick();
  if (status == NodeStatus::IDLE) {
    throw LogicError("node '", lockstep_name_, "' has returned IDLE, which is no result of a tick");
  }
  setStatus(status == NodeStatus::SKIPPED ? NodeStatus::IDLE : status);
  return status;
}

inline void TreeNode::lockstep_tell(NodeStatus before, NodeStatus status) {
  lockstep_watch_->changes.notify(std::chrono::high_resolution_clock::now(), *this, before, status);
}

inline NodeStatus TreeNode::lockstep_watched_tick() {
  NodeStatus status = NodeStatus::IDLE;
  if (lockstep_watch_->before && !isStatusCompleted(this->status()))
    status = lockstep_watch_->before(*this);
  if (!isStatusCompleted(status)) {
    const auto began = std::chrono::steady_clock::now();
    status = tick();
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

template <class T>
T TreeNode::parseString(const std::string& text) const {
  auto value = lockstep_detail::parse_with<T>(text, lockstep_config_.enums.get());
  if (!value) throw RuntimeError(value.error());
  return std::move(*value);
}

inline void TreeNode::emitWakeUpSignal() {
  if (lockstep_place_ != nullptr && lockstep_place_->is_in_tick())
    lockstep_place_->node->ask_for_tick(lockstep_place_->caller);
}

inline const lockstep_detail::PortEntry* TreeNode::lockstep_find_port(StringView port) const {
  if (lockstep_place_ == nullptr || lockstep_place_->registration == nullptr) return nullptr;
  for (const lockstep_detail::PortEntry& it : lockstep_place_->registration->ports) {
    if (it.name == port) return &it;
  }
  return nullptr;
}

inline std::string TreeNode::lockstep_no_port(StringView port) const {
  if (lockstep_place_ == nullptr)
    return StrCat("'", lockstep_name_, "' is not in a tree, so it has no ports");
  return StrCat("'", lockstep_registration_name_, "' has no port '", port,
                "': list it in its providedPorts()");
}

template <class T>
Expected<T> TreeNode::getInput(StringView name) const {
  const lockstep_detail::PortEntry* const port = lockstep_find_port(name);
  if (port == nullptr) return nonstd::make_unexpected(lockstep_no_port(name));
  if (lockstep_thread_ != nullptr && lockstep::detail::in_worker) {
    return lockstep_detail::converted<T>(lockstep_thread_->inputs[port->index],
                                         lockstep_config_.enums.get());
  }
  if constexpr (lockstep_detail::port_type<T>() != LOCKSTEP_ANY) {
    if (port->info.lockstep_values().type == lockstep_detail::port_type<T>()) {
      T value{};
      if (lockstep_detail::get(*lockstep_place_, port->index, value)) return value;
    }
  }
  return lockstep_read_other<T>(*port);
}

template <class T>
Result TreeNode::getInput(StringView name, T& value) const {
  auto read = getInput<T>(name);
  if (!read) return nonstd::make_unexpected(std::move(read.error()));
  value = std::move(*read);
  return std::monostate{};
}

// A value of another type than the port's, a text, or the default.
template <class T>
Expected<T> TreeNode::lockstep_read_other(const lockstep_detail::PortEntry& port) const {
  const lockstep_type type = lockstep_place_->node->value_type(lockstep_place_->caller, port.index);
  if (type == 0) return lockstep_read_default<T>(port);
  lockstep_detail::Place& place = *lockstep_place_;
  if (type == LOCKSTEP_STRING) {
    std::string text;
    if (lockstep_detail::get(place, port.index, text))
      return lockstep_detail::parse_with<T>(text, lockstep_config_.enums.get());
  }
  Any value;
  if (type == LOCKSTEP_OBJECT) {
    if constexpr (lockstep_detail::port_type<T>() == LOCKSTEP_OBJECT) {
      T object{};
      if (lockstep_detail::get(place, port.index, object)) return object;
    }
  } else if (!lockstep_detail::get_any(place, port.index, type, value)) {
    port.info.lockstep_values().get(place, port.index, value);
  }
  auto cast = value.tryCast<T>();
  if (cast) return std::move(*cast);
  return nonstd::make_unexpected(StrCat("port '", port.name, "': ", cast.error()));
}

inline Expected<Any> TreeNode::lockstep_read_any(const lockstep_detail::PortEntry& port) const {
  Any value;
  if (port.info.lockstep_values().get(*lockstep_place_, port.index, value)) return value;
  return lockstep_read_other<Any>(port);
}

inline void TreeNode::lockstep_begin_thread() {
  lockstep_thread_ = std::make_unique<LockstepThreadPorts>();
  for (const lockstep_detail::PortEntry& port : lockstep_place_->registration->ports) {
    lockstep_thread_->inputs.push_back(lockstep_read_any(port));
  }
}

inline void TreeNode::lockstep_end_thread() {
  const auto ports = std::move(lockstep_thread_);
  for (const auto& [port, value] : ports->outputs) {
    const lockstep_detail::PortValues& values = port->info.lockstep_values();
    values.set(*lockstep_place_, port->index,
               value.isString() && values.type != LOCKSTEP_STRING && values.type != LOCKSTEP_ANY
                   ? values.parse(value.cast<std::string>())
                   : value);
  }
}

template <class T>
Expected<T> TreeNode::lockstep_read_default(const lockstep_detail::PortEntry& port) const {
  const char* const given = lockstep_place_->node->given(lockstep_place_->caller, port.index);
  const Any& value = port.info.defaultValue();
  if (given != nullptr) {
    return nonstd::make_unexpected(
        StrCat("port '", port.name, "' has no value: nothing has written the entry '", given, "'"));
  }
  if (value.empty()) {
    return nonstd::make_unexpected(StrCat("port '", port.name, "' has no value and no default"));
  }
  if (value.isString()) {
    return lockstep_detail::parse_with<T>(value.cast<std::string>(), lockstep_config_.enums.get());
  }
  return value.tryCast<T>();
}

template <class T>
Result TreeNode::setOutput(StringView name, const T& value) {
  const lockstep_detail::PortEntry* const port = lockstep_find_port(name);
  if (port == nullptr) return nonstd::make_unexpected(lockstep_no_port(name));
  if (port->info.direction() == PortDirection::INPUT) {
    return nonstd::make_unexpected(StrCat("port '", name, "' is an input"));
  }
  using Value = std::decay_t<const T>;
  if (lockstep_thread_ != nullptr && lockstep::detail::in_worker) {
    if constexpr (std::is_same_v<Value, Any>) {
      lockstep_thread_->outputs.emplace_back(port, value);
    } else {
      lockstep_thread_->outputs.emplace_back(port, Any(value));
    }
    return std::monostate{};
  }
  const lockstep_detail::PortValues& values = port->info.lockstep_values();
  bool is_set = false;
  if constexpr (std::is_same_v<Value, Any>) {
    is_set = values.set(*lockstep_place_, port->index, value);
  } else if (values.type == lockstep_detail::port_type<Value>() || values.type == LOCKSTEP_ANY) {
    is_set = lockstep_detail::set<Value>(*lockstep_place_, port->index, value);
  } else if constexpr (lockstep_detail::is_text_v<Value>) {
    is_set = values.set(*lockstep_place_, port->index, values.parse(value));
  } else {
    is_set = values.set(*lockstep_place_, port->index, Any(value));
  }
  if (is_set) return std::monostate{};
  const char* const given = lockstep_place_->node->given(lockstep_place_->caller, port->index);
  if (given == nullptr || !isBlackboardPointer(given)) {
    return nonstd::make_unexpected(
        StrCat("port '", name, "' is bound to no entry; write ", name, "=\"{key}\""));
  }
  return nonstd::make_unexpected(
      StrCat("port '", name, "': the entry '", given, "' does not take this value"));
}

template <class T>
Expected<Timestamp> TreeNode::getInputStamped(StringView name, T& value) const {
  const auto result = getInput(name, value);
  if (!result) return nonstd::make_unexpected(result.error());
  return Timestamp{};
}

template <class T>
Expected<StampedValue<T>> TreeNode::getInputStamped(StringView name) const {
  auto value = getInput<T>(name);
  if (!value) return nonstd::make_unexpected(value.error());
  return StampedValue<T>{std::move(*value), {}};
}

inline AnyPtrLocked TreeNode::getLockedPortContent(const std::string& name) {
  const lockstep_detail::PortEntry* const port = lockstep_find_port(name);
  if (port == nullptr) return {};
  const char* const given = lockstep_place_->node->given(lockstep_place_->caller, port->index);
  if (given == nullptr || !isBlackboardPointer(given)) return {};
  return {lockstep_read_any(*port).value_or(Any()), [this, port](const Any& changed) {
            port->info.lockstep_values().set(*lockstep_place_, port->index, changed);
          }};
}

inline StringView TreeNode::getRawPortValue(const std::string& port) const {
  for (const PortsRemapping* ports :
       {&lockstep_config_.input_ports, &lockstep_config_.output_ports}) {
    if (const auto found = ports->find(port); found != ports->end()) return found->second;
  }
  throw LogicError("[", port, "] is no port of '", lockstep_name_, "'");
}

inline bool TreeNode::isBlackboardPointer(StringView text, StringView* stripped) {
  constexpr StringView kBlanks = " \t\n\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == StringView::npos) return false;
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.size() < 3 || text.front() != '{' || text.back() != '}') return false;
  if (stripped != nullptr) *stripped = text.substr(1, text.size() - 2);
  return true;
}

inline StringView TreeNode::stripBlackboardPointer(StringView text) {
  StringView key;
  return isBlackboardPointer(text, &key) ? key : StringView();
}

inline Expected<StringView> TreeNode::getRemappedKey(StringView port, StringView given) {
  StringView key;
  if (given == "{=}" || given == "=") return port;
  if (isBlackboardPointer(given, &key)) return key;
  return nonstd::make_unexpected(std::string("it is no entry"));
}

template <class T, class... Arguments>
std::unique_ptr<TreeNode> TreeNode::Instantiate(const std::string& name, const NodeConfig& config,
                                                Arguments... arguments) {
  if constexpr (std::is_constructible_v<T, const std::string&, const NodeConfig&, Arguments...>) {
    return std::make_unique<T>(name, config, arguments...);
  } else {
    auto node = std::make_unique<T>(name, arguments...);
    static_cast<TreeNode&>(*node).config() = config;
    return node;
  }
}

}  // namespace BT
