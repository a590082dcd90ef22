// The templates of tree_node.h, and what they inline. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/tree_node.h"

namespace BT {
namespace lockstep_detail {

// A value that was read before, as a T.
template <class T>
Expected<T> converted(const Expected<Any>& value, const NodeConfig& config) {
  if (!value) return nonstd::make_unexpected(value.error());
  if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, Any>) {
    if (value->isString())
      return parse_with<T>(value->template cast<std::string>(), config.enums.get());
  }
  return config.blackboard->template tryCastWithPolymorphicFallback<T>(&*value);
}

template <class T>
constexpr bool is_number_or_bool() {
  constexpr lockstep_type kType = port_type<T>();
  return kType == LOCKSTEP_BOOL || kType == LOCKSTEP_INT || kType == LOCKSTEP_DOUBLE;
}

// A constant of the tree as a T, of which port_type<T>() is the type; false: T has no such value.
template <class T>
bool from_constant(const void* constant, T& value) {
  if constexpr (port_type<T>() == LOCKSTEP_INT) {
    return convert_number(*static_cast<const std::int64_t*>(constant), value);
  } else if constexpr (port_type<T>() == LOCKSTEP_DOUBLE) {
    value = static_cast<T>(*static_cast<const double*>(constant));
  } else {
    value = *static_cast<const bool*>(constant);
  }
  return true;
}

// False: there is no such value, or, unless it is a constant, a thread of the node may be asking.
template <class T>
[[gnu::always_inline]] inline bool get_at_once(const Place& place, const PortEntry& port,
                                               bool has_thread, T& value) {
  if (port.info.lockstep_values().type != port_type<T>()) return false;
  const void* const constant = place.constants == nullptr ? nullptr : place.constants[port.index];
  if (constant != nullptr) return from_constant(constant, value);
  return !has_thread && get(place, port.index, value);
}

// Where the node under construction finds its place, so that its class need not pass it on.
[[gnu::visibility("hidden")]] inline thread_local Place* creating = nullptr;

}  // namespace lockstep_detail

template <class Work>
inline NodeStatus TreeNode::lockstep_tick_as(Work work) {
  if (lockstep_watch_ != nullptr) return lockstep_noted(lockstep_watched_work(work));
  const NodeStatus status = lockstep_work(work);
  const bool is_usual = isStatusCompleted(status) || status == NodeStatus::RUNNING;
  if (!is_usual || lockstep_watch_ != nullptr) return lockstep_noted(status);
  lockstep_status_.store(status, std::memory_order_release);
  return status;
}

template <class Work>
inline NodeStatus TreeNode::lockstep_result_of(Work work) {
  const NodeStatus status =
      lockstep_watch_ == nullptr ? lockstep_work(work) : lockstep_watched_work(work);
  if (status == NodeStatus::IDLE) lockstep_refuse_idle();
  return status;
}

template <class Work>
inline NodeStatus TreeNode::lockstep_work(const Work& work) {
  try {
    return work();
  } catch (const std::exception& thrown) {
    lockstep_rethrow(thrown);
  }
}

template <class T>
T TreeNode::parseString(const std::string& text) const {
  auto value = lockstep_detail::parse_with<T>(text, lockstep_config_.enums.get());
  if (!value) throw RuntimeError(value.error());
  return std::move(*value);
}

inline const lockstep_detail::PortEntry* TreeNode::lockstep_find_port(StringView port) const {
  if (lockstep_place_ == nullptr) return nullptr;
  for (const lockstep_detail::PortEntry& it : lockstep_place_->registration->ports) {
    if (it.name == port) return &it;
  }
  return nullptr;
}

// It is compiled into its caller, where the compiler knows the length of the name.
template <class T>
inline Expected<T> TreeNode::getInput(StringView name) const {
  const lockstep_detail::PortEntry* const port = lockstep_find_port(name);
  if constexpr (lockstep_detail::is_number_or_bool<T>()) {
    T value{};
    const bool has_thread = lockstep_thread_ != nullptr;
    if (port != nullptr &&
        lockstep_detail::get_at_once(*lockstep_place_, *port, has_thread, value)) {
      return value;
    }
  }
  return lockstep_read<T>(name, port);
}

template <class T>
Expected<T> TreeNode::lockstep_read(StringView name, const lockstep_detail::PortEntry* port) const {
  if (lockstep_place_ == nullptr) return lockstep_read_by_hand<T>(std::string(name));
  if (port == nullptr) {  // one of the node that it stands in for
    if (lockstep_config_.input_ports.count(std::string(name)) == 0) {
      return nonstd::make_unexpected(lockstep_no_port(name));
    }
    return lockstep_read_by_hand<T>(std::string(name));
  }
  if (lockstep_thread_ != nullptr && lockstep::detail::in_worker) {
    return lockstep_detail::converted<T>(lockstep_thread_->inputs[port->index], lockstep_config_);
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
inline Result TreeNode::getInput(StringView name, T& value) const {
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
    lockstep_detail::get_any_object(place, port.index, value);
  } else if (!lockstep_detail::get_any(place, port.index, type, value)) {
    port.info.lockstep_values().get(place, port.index, value);
  }
  auto cast = lockstep_config_.blackboard->template tryCastWithPolymorphicFallback<T>(&value);
  if (cast) return std::move(*cast);
  return nonstd::make_unexpected(StrCat("port '", port.name, "': ", cast.error()));
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
  if (port == nullptr) {
    // Such a port is in no tree, or belongs to the node that this one stands in for.
    const bool is_given = lockstep_config_.output_ports.count(std::string(name)) != 0;
    if (lockstep_place_ != nullptr && !is_given) {
      return nonstd::make_unexpected(lockstep_no_port(name));
    }
    using Held =
        std::conditional_t<lockstep_detail::is_text_v<std::decay_t<const T>>, std::string, T>;
    if constexpr (std::is_same_v<T, Any>) {
      return lockstep_set_by_hand(std::string(name), value, TypeInfo::Create<Any>());
    } else {
      return lockstep_set_by_hand(std::string(name), Any(value), TypeInfo::Create<Held>());
    }
  }
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
  throw LogicError("port '", name, "': the entry '", given, "' does not take this value");
}

template <class T>
Expected<Timestamp> TreeNode::getInputStamped(StringView name, T& value) const {
  lockstep_detail::note_opening<T>();
  const auto result = getInput(name, value);
  if (!result) return nonstd::make_unexpected(result.error());
  return lockstep_stamp_of(std::string(name));
}

template <class T>
Expected<StampedValue<T>> TreeNode::getInputStamped(StringView name) const {
  lockstep_detail::note_opening<T>();
  auto value = getInput<T>(name);
  if (!value) return nonstd::make_unexpected(value.error());
  return StampedValue<T>{std::move(*value), lockstep_stamp_of(std::string(name))};
}

template <class T>
Expected<T> TreeNode::lockstep_read_by_hand(const std::string& port) const {
  const auto found = lockstep_config_.input_ports.find(port);
  const std::unordered_map<std::string, int>* const enums = lockstep_config_.enums.get();
  std::string given;
  if (found != lockstep_config_.input_ports.end()) {
    given = found->second;
  } else {
    const TreeNodeManifest* const manifest = lockstep_config_.manifest;
    if (manifest == nullptr || manifest->ports.count(port) == 0) {
      return nonstd::make_unexpected(StrCat("'", lockstep_name_, "' has no value for the port '",
                                            port, "': put one into NodeConfig::input_ports"));
    }
    const Any& value = manifest->ports.at(port).defaultValue();
    if (value.empty()) {
      return nonstd::make_unexpected(StrCat("port '", port, "' has no value and no default"));
    }
    if (!value.isString()) return value.tryCast<T>();
    given = value.cast<std::string>();
  }
  const auto key = getRemappedKey(port, given);
  if (!key) return lockstep_detail::parse_with<T>(given, enums);
  if (lockstep_config_.blackboard == nullptr) {
    return nonstd::make_unexpected(
        StrCat("port '", port, "' names an entry, and the NodeConfig has no blackboard"));
  }
  const auto content =
      Blackboard::lockstep_locked(lockstep_config_.blackboard->lockstep_find(std::string(*key)));
  if (!content || content.get()->empty()) {
    return nonstd::make_unexpected(
        StrCat("port '", port, "' has no value: nothing has written the entry '", given, "'"));
  }
  return lockstep_detail::converted<T>(Expected<Any>(*content.get()), lockstep_config_);
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

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/tree_node.h"  // IWYU pragma: export
#endif
