// The functions of tree_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT {
namespace detail {

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

}  // namespace detail

inline TreeNode::TreeNode(std::string name, NodeConfig config)
    : name_(std::move(name)),
      config_(std::move(config)),
      place_(std::exchange(detail::creating, nullptr)) {}

inline NodeStatus TreeNode::executeTick() {
  const NodeStatus status = watch_ == nullptr ? tick() : watched_tick();
  if (status == NodeStatus::IDLE) {
    throw LogicError("node '", name_, "' has returned IDLE, which is no result of a tick");
  }
  setStatus(status == NodeStatus::SKIPPED ? NodeStatus::IDLE : status);
  return status;
}

inline void TreeNode::tell(NodeStatus before, NodeStatus status) {
  watch_->changes.notify(std::chrono::high_resolution_clock::now(), *this, before, status);
}

inline NodeStatus TreeNode::watched_tick() {
  NodeStatus status = NodeStatus::IDLE;
  if (watch_->before && !isStatusCompleted(this->status())) status = watch_->before(*this);
  if (!isStatusCompleted(status)) {
    const auto began = std::chrono::steady_clock::now();
    status = tick();
    const auto took = std::chrono::steady_clock::now() - began;
    if (watch_->monitor) {
      watch_->monitor(*this, status, std::chrono::duration_cast<std::chrono::microseconds>(took));
    }
  }
  if (watch_->after) {
    const NodeStatus decided = watch_->after(*this, status);
    if (isStatusCompleted(decided)) status = decided;
  }
  return status;
}

template <class T>
T TreeNode::parseString(const std::string& text) const {
  auto value = detail::parse_with<T>(text, config_.enums.get());
  if (!value) throw RuntimeError(value.error());
  return std::move(*value);
}

inline void TreeNode::emitWakeUpSignal() {
  if (place_ != nullptr && place_->is_in_tick()) place_->node->ask_for_tick(place_->caller);
}

inline const detail::PortEntry* TreeNode::find(StringView port) const {
  if (place_ == nullptr || place_->registration == nullptr) return nullptr;
  for (const detail::PortEntry& it : place_->registration->ports) {
    if (it.name == port) return &it;
  }
  return nullptr;
}

inline std::string TreeNode::no_port(StringView port) const {
  if (place_ == nullptr) return StrCat("'", name_, "' is not in a tree, so it has no ports");
  return StrCat("'", registration_name_, "' has no port '", port,
                "': list it in its providedPorts()");
}

template <class T>
Expected<T> TreeNode::getInput(StringView name) const {
  const detail::PortEntry* const port = find(name);
  if (port == nullptr) return nonstd::make_unexpected(no_port(name));
  if (thread_ != nullptr && lockstep::detail::in_worker) {
    return detail::converted<T>(thread_->inputs[port->index], config_.enums.get());
  }
  if constexpr (detail::port_type<T>() != LOCKSTEP_ANY) {
    if (port->info.values().type == detail::port_type<T>()) {
      T value{};
      if (detail::get(*place_, port->index, value)) return value;
    }
  }
  return read_other<T>(*port);
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
Expected<T> TreeNode::read_other(const detail::PortEntry& port) const {
  const lockstep_type type = place_->node->value_type(place_->caller, port.index);
  if (type == 0) return read_default<T>(port);
  detail::Place& place = *place_;
  if (type == LOCKSTEP_STRING) {
    std::string text;
    if (detail::get(place, port.index, text))
      return detail::parse_with<T>(text, config_.enums.get());
  }
  Any value;
  if (type == LOCKSTEP_OBJECT) {
    if constexpr (detail::port_type<T>() == LOCKSTEP_OBJECT) {
      T object{};
      if (detail::get(place, port.index, object)) return object;
    }
  } else if (!detail::get_any(place, port.index, type, value)) {
    port.info.values().get(place, port.index, value);
  }
  auto cast = value.tryCast<T>();
  if (cast) return std::move(*cast);
  return nonstd::make_unexpected(StrCat("port '", port.name, "': ", cast.error()));
}

inline Expected<Any> TreeNode::read_any(const detail::PortEntry& port) const {
  Any value;
  if (port.info.values().get(*place_, port.index, value)) return value;
  return read_other<Any>(port);
}

inline void TreeNode::begin_thread() {
  thread_ = std::make_unique<ThreadPorts>();
  for (const detail::PortEntry& port : place_->registration->ports) {
    thread_->inputs.push_back(read_any(port));
  }
}

inline void TreeNode::end_thread() {
  const auto ports = std::move(thread_);
  for (const auto& [port, value] : ports->outputs) {
    const detail::PortValues& values = port->info.values();
    values.set(*place_, port->index,
               value.isString() && values.type != LOCKSTEP_STRING && values.type != LOCKSTEP_ANY
                   ? values.parse(value.cast<std::string>())
                   : value);
  }
}

template <class T>
Expected<T> TreeNode::read_default(const detail::PortEntry& port) const {
  const char* const given = place_->node->given(place_->caller, port.index);
  const Any& value = port.info.defaultValue();
  if (given != nullptr) {
    return nonstd::make_unexpected(
        StrCat("port '", port.name, "' has no value: nothing has written the entry '", given, "'"));
  }
  if (value.empty()) {
    return nonstd::make_unexpected(StrCat("port '", port.name, "' has no value and no default"));
  }
  if (value.isString()) {
    return detail::parse_with<T>(value.cast<std::string>(), config_.enums.get());
  }
  return value.tryCast<T>();
}

template <class T>
Result TreeNode::setOutput(StringView name, const T& value) {
  const detail::PortEntry* const port = find(name);
  if (port == nullptr) return nonstd::make_unexpected(no_port(name));
  if (port->info.direction() == PortDirection::INPUT) {
    return nonstd::make_unexpected(StrCat("port '", name, "' is an input"));
  }
  using Value = std::decay_t<const T>;
  if (thread_ != nullptr && lockstep::detail::in_worker) {
    if constexpr (std::is_same_v<Value, Any>) {
      thread_->outputs.emplace_back(port, value);
    } else {
      thread_->outputs.emplace_back(port, Any(value));
    }
    return std::monostate{};
  }
  const detail::PortValues& values = port->info.values();
  bool is_set = false;
  if constexpr (std::is_same_v<Value, Any>) {
    is_set = values.set(*place_, port->index, value);
  } else if (values.type == detail::port_type<Value>() || values.type == LOCKSTEP_ANY) {
    is_set = detail::set<Value>(*place_, port->index, value);
  } else if constexpr (detail::is_text_v<Value>) {
    is_set = values.set(*place_, port->index, values.parse(value));
  } else {
    is_set = values.set(*place_, port->index, Any(value));
  }
  if (is_set) return std::monostate{};
  const char* const given = place_->node->given(place_->caller, port->index);
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
  const detail::PortEntry* const port = find(name);
  if (port == nullptr) return {};
  const char* const given = place_->node->given(place_->caller, port->index);
  if (given == nullptr || !isBlackboardPointer(given)) return {};
  return {read_any(*port).value_or(Any()), [this, port](const Any& changed) {
            port->info.values().set(*place_, port->index, changed);
          }};
}

inline StringView TreeNode::getRawPortValue(const std::string& port) const {
  for (const PortsRemapping* ports : {&config_.input_ports, &config_.output_ports}) {
    if (const auto found = ports->find(port); found != ports->end()) return found->second;
  }
  throw LogicError("[", port, "] is no port of '", name_, "'");
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
