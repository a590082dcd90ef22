// The templates of blackboard.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/blackboard.h"
#include "behaviortree_cpp/lockstep/number_type.h"

namespace BT {
namespace lockstep_detail {

bool is_of_root(StringView key);

std::chrono::nanoseconds stamp_now();

// A number has the C++ type of its entry, and stays whole or real as it is.
Any as_declared(const TypeInfo& info, Any value);

// Takes the value of the tree if it is new. Under the locks of both.
void refresh(Blackboard::Entry& entry, const lockstep_entry_value& value);

// A value that was found in an entry, as a T.
template <class T>
Expected<T> value_as(const BoardCasts& casts, const Any& value) {
  if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, Any>) {
    if (value.isString()) {
      if (auto cast = value.tryCast<T>()) return cast;
      return parse<T>(value.cast<std::string>());
    }
  }
  return casts.template tryCastWithPolymorphicFallback<T>(&value);
}

std::string no_value(const std::string& key);

}  // namespace lockstep_detail

// An entry for the time of its scope: its mutex, and the entries of its tree. What has changed
// there is in it then.
class Blackboard::Locked {
 public:
  explicit Locked(const LockstepFound& found) : link_(found.link.get()), entry_(*found.entry) {
    if (link_ == nullptr) {
      entry_.entry_mutex.lock();
      return;
    }
    std::lock(*link_, entry_.entry_mutex);
    lockstep_entry_value value{};
    value.struct_size = sizeof value;
    if (link_->read(found.key, value)) lockstep_detail::refresh(entry_, value);
  }
  ~Locked() {
    entry_.entry_mutex.unlock();
    if (link_ != nullptr) link_->unlock();
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  const lockstep_detail::BoardLink* const link_;
  Entry& entry_;
};

// --- of a tree that runs -------------------------------------------------------------------------

// --- templates -----------------------------------------------------------------------------------

template <class T>
Expected<StampedValue<T>> Blackboard::getStamped(const std::string& key) const {
  lockstep_open_as<T>();
  const LockstepFound found = lockstep_find(key);
  if (found.entry == nullptr) {
    return nonstd::make_unexpected(StrCat("there is no entry '", key, "'"));
  }
  const Locked lock(found);
  const Entry& entry = *found.entry;
  if (entry.value.empty()) return nonstd::make_unexpected(lockstep_detail::no_value(key));
  auto value = lockstep_detail::value_as<T>(*this, entry.value);
  if (!value) return nonstd::make_unexpected(std::move(value.error()));
  return StampedValue<T>{std::move(*value), {entry.sequence_id, entry.stamp}};
}

template <class T>
Expected<Timestamp> Blackboard::getStamped(const std::string& key, T& value) const {
  auto found = getStamped<T>(key);
  if (!found) return nonstd::make_unexpected(std::move(found.error()));
  value = std::move(found->value);
  return found->stamp;
}

template <class T>
T Blackboard::get(const std::string& key) const {
  lockstep_open_as<T>();
  const LockstepFound found = lockstep_find(key);
  if (found.entry == nullptr) throw RuntimeError("Blackboard::get: there is no entry '", key, "'");
  if (auto value = lockstep_value<T>(found)) return std::move(*value);
  throw RuntimeError("Blackboard::get: ", lockstep_detail::no_value(key));
}

template <class T>
bool Blackboard::get(const std::string& key, T& value) const {
  lockstep_open_as<T>();
  const LockstepFound found = lockstep_find(key);
  auto held = found.entry == nullptr ? std::nullopt : lockstep_value<T>(found);
  if (held) value = std::move(*held);
  return held.has_value();
}

// Nothing: nothing has written it. Throws when it has another type.
template <class T>
std::optional<T> Blackboard::lockstep_value(const LockstepFound& found) const {
  const Locked lock(found);
  if (found.entry->value.empty()) return std::nullopt;
  auto value = lockstep_detail::value_as<T>(*this, found.entry->value);
  if (!value) throw std::runtime_error("Blackboard::get: " + value.error());
  return std::move(*value);
}

template <class T>
void Blackboard::set(const std::string& key, const T& value) {
  using Value = std::decay_t<const T>;
  lockstep_open<Value>();
  if constexpr (std::is_same_v<Value, Any>) {
    lockstep_set(key, value, TypeInfo::Create<Any>());
  } else {
    using Held = std::conditional_t<lockstep_detail::is_text_v<Value>, std::string, Value>;
    lockstep_set(key, Any(value), TypeInfo::Create<Held>());
  }
}

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/blackboard.h"  // IWYU pragma: export
#endif
