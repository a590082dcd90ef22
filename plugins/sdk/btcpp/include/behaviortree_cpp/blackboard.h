// The entries of a tree, by name. In a tree they are those of lockstep: a leaf reads and writes
// them in the thread that ticks it. A Blackboard that a program makes holds its values itself.
#pragma once

#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/opened_entry.h"
#include "behaviortree_cpp/utils/locked_reference.hpp"

namespace BT {

template <class T>
struct StampedValue {
  T value;
  Timestamp stamp;
};

namespace lockstep_detail {

// Entries of a tree that a program ticks.
class EntryStore {
 public:
  virtual ~EntryStore() = default;
  // False: there is no such entry, or it has no value; it does not take the value.
  virtual bool get(const std::string& key, Any& value) const = 0;
  virtual bool set(const std::string& key, const Any& value) = 0;
};

}  // namespace lockstep_detail

class Blackboard {
 public:
  using Ptr = std::shared_ptr<Blackboard>;

  // What an entry is when it is asked for.
  struct Entry {
    explicit Entry(const TypeInfo& type) : info(type), string_converter(type.converter()) {}
    Any value;
    TypeInfo info;
    StringConverter string_converter;
    mutable std::mutex entry_mutex;  // a tree is ticked by one thread: nothing to lock
    std::uint64_t sequence_id = 0;
    std::chrono::nanoseconds stamp{0};
  };
  static Ptr create(Ptr parent = {}) { return Ptr(new Blackboard(std::move(parent))); }
  Blackboard(const Blackboard&) = delete;
  Blackboard& operator=(const Blackboard&) = delete;

  // Throws when there is no entry, no value, or one of another type.
  template <class T>
  [[nodiscard]] T get(const std::string& key) const {
    auto value = lockstep_read<T>(key);
    if (value) return std::move(*value);
    const std::string message = "Blackboard::get: " + value.error();
    if (lockstep_has_value(key)) throw std::runtime_error(message);  // of another type
    throw RuntimeError(message);
  }
  template <class T>
  Expected<StampedValue<T>> getStamped(const std::string& key) const {
    auto value = lockstep_read<T>(key);
    if (!value) return nonstd::make_unexpected(value.error());
    return StampedValue<T>{std::move(*value), {}};
  }
  template <class T>
  Expected<Timestamp> getStamped(const std::string& key, T& value) const {
    auto read_value = lockstep_read<T>(key);
    if (!read_value) return nonstd::make_unexpected(read_value.error());
    value = std::move(*read_value);
    return Timestamp{};
  }
  // False when there is no value; throws when it has another type.
  template <class T>
  bool get(const std::string& key, T& value) const {
    if (!lockstep_has_value(key)) return false;
    value = get<T>(key);
    return true;
  }
  template <class T>
  void set(const std::string& key, const T& value) {
    using Value = std::decay_t<const T>;
    if (lockstep_place_ != nullptr) {
      lockstep_detail::OpenedEntry(*lockstep_place_, lockstep_prefix_ + key)
          .template set<Value>(value);
    } else if constexpr (std::is_same_v<Value, Any>) {
      lockstep_keep(key, value);
    } else {
      lockstep_keep(key, Any(value));
    }
  }
  template <class Key = std::string>
  void unset(const Key& key) {
    if (lockstep_place_ != nullptr) {
      lockstep_detail::OpenedEntry(*lockstep_place_, lockstep_prefix_ + key).unset();
    } else {
      lockstep_values_.erase(std::string(key));
    }
  }

  // The value, which may be changed in place; false when there is none.
  template <class Key = std::string>
  [[nodiscard]] AnyPtrLocked getAnyLocked(const Key& key) const {
    Any value;
    if (lockstep_place_ != nullptr) {
      const lockstep_detail::OpenedEntry entry(*lockstep_place_, lockstep_prefix_ + key);
      if (!entry.get(value)) return {};
      return {std::move(value), [entry](const Any& changed) { entry.set(changed); }};
    }
    if (!lockstep_find(key, value)) return {};
    auto* const self = const_cast<Blackboard*>(this);  // NOLINT: as getAnyLocked promises
    return {std::move(value),
            [self, key](const Any& changed) { self->lockstep_keep(key, changed); }};
  }

  // A copy of it; null: there is no such entry, or it has no value.
  template <class Key = std::string>
  [[nodiscard]] std::shared_ptr<Entry> getEntry(const Key& key) const {
    const AnyPtrLocked value = getAnyLocked(key);
    if (!value) return nullptr;
    auto entry = std::make_shared<Entry>(TypeInfo::lockstep_of(*value));
    entry->value = *value;
    return entry;
  }
  // The type of the value that it has; null: it has none.
  template <class Key = std::string>
  [[nodiscard]] const TypeInfo* entryInfo(const Key& key) {
    const auto entry = getEntry(key);
    if (entry == nullptr) return nullptr;
    return &(lockstep_types_[std::string(key)] = entry->info);
  }

  // The one of the main tree, and the one outside.
  Blackboard* rootBlackboard() {
    return lockstep_place_ != nullptr    ? lockstep_root_.get()
           : lockstep_parent_ != nullptr ? lockstep_parent_->rootBlackboard()
                                         : this;
  }
  const Blackboard* rootBlackboard() const {
    return const_cast<Blackboard*>(this)->rootBlackboard();  // NOLINT
  }
  Ptr parent() const { return lockstep_parent_; }

  // The entries of a Blackboard that a program has made.
  std::vector<StringView> getKeys() const {
    std::vector<StringView> keys;
    for (const auto& [key, value] : lockstep_values_) keys.push_back(key);
    return keys;
  }
  const std::map<std::string, Any>& lockstep_values() const { return lockstep_values_; }
  void cloneInto(Blackboard& other) const {
    for (const auto& [key, value] : lockstep_values_) other.lockstep_keep(key, value);
  }
  void debugMessage() const {
    for (const auto& [key, value] : lockstep_values_) {
      std::cout << key << " (" << demangle(value.type()) << ")" << std::endl;
    }
  }

  // For the tree that has it. What was set before becomes values of its entries.
  void lockstep_attach(const std::shared_ptr<lockstep_detail::EntryStore>& entries) {
    if (lockstep_parent_ != nullptr) lockstep_parent_->lockstep_attach(entries);
    lockstep_entries_ = entries;
    for (auto it = lockstep_values_.begin(); it != lockstep_values_.end();) {
      it = lockstep_entries_->set(it->first, it->second) ? lockstep_values_.erase(it)
                                                         : std::next(it);
    }
  }

  // For the node that has it.
  static Ptr lockstep_at(lockstep_detail::Place& place) {
    auto root = Ptr(new Blackboard({}));
    root->lockstep_place_ = &place;
    root->lockstep_prefix_ = "@";
    auto board = Ptr(new Blackboard({}));
    board->lockstep_place_ = &place;
    board->lockstep_root_ = std::move(root);
    return board;
  }

 private:
  void lockstep_keep(const std::string& key, Any value) {
    if (lockstep_entries_ != nullptr && lockstep_entries_->set(key, value)) return;
    lockstep_values_[key] = std::move(value);
  }

  explicit Blackboard(Ptr parent) : lockstep_parent_(std::move(parent)) {}

  template <class T>
  Expected<T> lockstep_read(const std::string& key) const {
    if (lockstep_place_ != nullptr)
      return lockstep_detail::OpenedEntry(*lockstep_place_, lockstep_prefix_ + key)
          .template get<T>();
    Any value;
    if (!lockstep_find(key, value)) {
      return nonstd::make_unexpected(StrCat("there is no entry '", key, "'"));
    }
    if constexpr (!std::is_same_v<T, std::string> && !std::is_same_v<T, Any>) {
      if (value.isString()) {
        const auto text = value.cast<std::string>();
        Any object;  // of an entry that a tree has: its text is JSON
        if (lockstep_entries_ != nullptr && lockstep_detail::read_json(typeid(T), text, object)) {
          return object.tryCast<T>();
        }
        return lockstep_detail::parse<T>(text);
      }
    }
    return value.tryCast<T>();
  }
  template <class Key>
  bool lockstep_has_value(const Key& key) const {
    Any value;
    if (lockstep_place_ != nullptr)
      return lockstep_detail::OpenedEntry(*lockstep_place_, lockstep_prefix_ + key).has_value();
    return lockstep_find(key, value);
  }
  bool lockstep_find(const std::string& key, Any& value) const {
    if (lockstep_entries_ != nullptr && lockstep_entries_->get(key, value)) return true;
    const auto found = lockstep_values_.find(key);
    if (found == lockstep_values_.end())
      return lockstep_parent_ != nullptr && lockstep_parent_->lockstep_find(key, value);
    value = found->second;
    return true;
  }

  Ptr lockstep_parent_, lockstep_root_;
  std::string lockstep_prefix_;
  lockstep_detail::Place* lockstep_place_ = nullptr;
  std::shared_ptr<lockstep_detail::EntryStore> lockstep_entries_;
  std::map<std::string, Any> lockstep_values_;
  std::map<std::string, TypeInfo> lockstep_types_;  // that entryInfo has given
};

}  // namespace BT
