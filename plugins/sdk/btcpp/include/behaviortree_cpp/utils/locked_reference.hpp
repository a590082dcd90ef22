// A value of an entry, to be read and changed in place. What was changed is written when this goes.
#pragma once

#include <functional>
#include <stdexcept>
#include <utility>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {

template <class T>
class LockedPtr;

template <>
class LockedPtr<Any> {
 public:
  using Write = std::function<void(const Any&)>;

  LockedPtr() = default;
  LockedPtr(Any value, Write write)
      : value_(std::move(value)), write_(std::move(write)), is_there_(true) {}
  LockedPtr(LockedPtr&& other) noexcept { *this = std::move(other); }
  LockedPtr& operator=(LockedPtr&& other) noexcept {
    finish();
    value_ = std::move(other.value_);
    write_ = std::exchange(other.write_, nullptr);
    is_there_ = std::exchange(other.is_there_, false);
    may_have_changed_ = std::exchange(other.may_have_changed_, false);
    return *this;
  }
  ~LockedPtr() { finish(); }

  // False: there is no such entry.
  operator bool() const { return is_there_; }  // NOLINT: as in the library

  const Any* get() const { return is_there_ ? &value_ : nullptr; }
  Any* get() {
    may_have_changed_ = is_there_;
    return is_there_ ? &value_ : nullptr;
  }
  const Any* operator->() const { return get(); }
  Any* operator->() { return get(); }
  const Any& operator*() const { return value_; }

  // The ticks of a tree are in one thread, so there is nothing to lock.
  void lock() {}
  void unlock() {}

  template <class Value>
  void assign(const Value& value) {
    if (!is_there_) throw std::runtime_error("LockedPtr::assign: there is no such entry");
    if constexpr (std::is_same_v<Value, Any>) {
      value_ = value;
    } else {
      value_ = Any(value);
    }
    may_have_changed_ = is_there_;
  }

 private:
  void finish() noexcept {
    if (!may_have_changed_ || !write_) return;
    try {
      if (!value_.empty()) write_(value_);
    } catch (...) {  // NOLINT(bugprone-empty-catch): the entry stays as it was
    }
    may_have_changed_ = false;
  }

  Any value_;
  Write write_;
  bool is_there_ = false, may_have_changed_ = false;
};

using AnyPtrLocked = LockedPtr<Any>;

}  // namespace BT
