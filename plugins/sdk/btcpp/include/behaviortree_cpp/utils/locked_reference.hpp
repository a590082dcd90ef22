// A value of an entry, to be read and changed in place. Nobody else uses it as long as this is
// there.
#pragma once

#include <functional>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "behaviortree_cpp/utils/safe_any.hpp"

namespace BT {

template <class T>
class LockedPtr {
 public:
  // Called when it ends; true: the value may have changed.
  using Finish = std::function<void(bool may_have_changed)>;

  LockedPtr() = default;
  LockedPtr(T* value, std::mutex* mutex) : value_(value), mutex_(mutex) { mutex_->lock(); }
  // `value` is locked already; `finish` unlocks it.
  LockedPtr(T* value, Finish finish) : value_(value), finish_(std::move(finish)) {}
  LockedPtr(LockedPtr&& other) noexcept { *this = std::move(other); }
  LockedPtr& operator=(LockedPtr&& other) noexcept {
    std::swap(value_, other.value_);
    std::swap(mutex_, other.mutex_);
    std::swap(finish_, other.finish_);
    std::swap(may_have_changed_, other.may_have_changed_);
    return *this;
  }
  ~LockedPtr() {
    if (mutex_ != nullptr) mutex_->unlock();
    if (finish_) finish_(may_have_changed_);
  }

  // False: there is no such entry.
  operator bool() const { return value_ != nullptr; }  // NOLINT: as in the library

  const T* get() const { return value_; }
  T* get() {
    may_have_changed_ = true;
    return value_;
  }
  const T* operator->() const { return value_; }
  T* operator->() { return get(); }
  const T& operator*() const { return *value_; }
  T& operator*() { return *get(); }

  void lock() {
    if (mutex_ != nullptr) mutex_->lock();
  }
  void unlock() {
    if (mutex_ != nullptr) mutex_->unlock();
  }

  // An Any takes the value inside.
  template <class Value>
  void assign(const Value& value) {
    if (value_ == nullptr) throw std::runtime_error("LockedPtr::assign: there is no such entry");
    may_have_changed_ = true;
    if constexpr (!std::is_same_v<T, Any> || std::is_same_v<Value, Any>) {
      *value_ = value;
    } else if (value_->empty()) {
      *value_ = Any(value);
    } else {
      Any(value).copyInto(*value_);
    }
  }

 private:
  T* value_ = nullptr;
  std::mutex* mutex_ = nullptr;
  Finish finish_;
  bool may_have_changed_ = false;
};

using AnyPtrLocked = LockedPtr<Any>;

}  // namespace BT
