// An entry of the tree that a leaf names itself, without a port.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/place.h"

namespace BT::lockstep_detail {

// Its value is true in a plugin whose code opens entries: only then is it made.
[[gnu::visibility("hidden")]] inline bool& opens_entries() {
  static bool opens = false;
  return opens;
}
template <class Use>
struct OpeningMark {
  static bool note() { return opens_entries() = true; }
  [[gnu::visibility("hidden")]] static inline const bool kNoted = note();
};

// The key may have any type that is a text, so that this is made only where it is used.
class OpenedEntry {
 public:
  template <class Key>
  OpenedEntry(const Place& place, const Key& key) : place_(place), key_(key) {
    static_cast<void>(OpeningMark<Key>::kNoted);
    port_ = place.node->open(place.caller, key_.data(), key_.size());
    if (port_ == UINT32_MAX) {
      throw RuntimeError("the entry '", key_,
                         "' cannot be used by its name here: in a constructor, "
                         "in an isolated plugin, or in a tree of lockstep's own language; use a "
                         "port");
    }
  }

  bool has_value() const { return place_.node->value_type(place_.caller, port_) != 0; }
  void unset() const { place_.node->unset(place_.caller, port_); }

  template <class T>
  Expected<T> get() const {
    const lockstep_type type = place_.node->value_type(place_.caller, port_);
    if (type == 0) {
      return nonstd::make_unexpected(StrCat("nothing has written the entry '", key_, "'"));
    }
    if constexpr (std::is_same_v<T, Any>) {
      Any value;
      if (get(value)) return value;
    } else {
      if constexpr (port_type<T>() != LOCKSTEP_ANY) {
        T value{};
        if (lockstep_detail::get(place_, port_, value)) return value;
      }
      Any value;
      if (get(value)) {
        if (value.isString()) return parse_with<T>(value.template cast<std::string>(), nullptr);
        if (auto cast = value.template tryCast<T>()) return cast;
      }
    }
    return nonstd::make_unexpected(
        StrCat("the entry '", key_, "' has no value of type ", readable(typeid(T))));
  }
  // For any type but an object's.
  bool get(Any& value) const {
    const lockstep_type type = place_.node->value_type(place_.caller, port_);
    std::string text;
    if (type != LOCKSTEP_STRING) return get_any(place_, port_, type, value);
    if (!lockstep_detail::get(place_, port_, text)) return false;
    value = Any(text);
    return true;
  }

  template <class T>
  void set(const T& value) const {
    bool is_set = false;
    if constexpr (std::is_same_v<T, Any>) {
      is_set = PortValue<Any>::set(place_, port_, value);
    } else {
      is_set = lockstep_detail::set<T>(place_, port_, value);
    }
    if (!is_set) {
      using Error = std::conditional_t<is_text_v<T>, RuntimeError, LogicError>;
      throw Error("Blackboard::set: the entry '", key_, "' does not take a value of type ",
                  readable(typeid(T)));
    }
  }

 private:
  const Place& place_;
  std::string key_;
  std::uint32_t port_ = 0;
};

}  // namespace BT::lockstep_detail
