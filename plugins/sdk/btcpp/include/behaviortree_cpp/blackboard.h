// The entries of a tree, by name: for nodes, also in their constructors, for programs, and for
// nodes that a program makes by hand. In a tree that runs it is a view of the entries that its
// scripts and ports have; else it holds them itself. Any thread may use it at any time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/board_link.h"
#include "behaviortree_cpp/lockstep/opening_mark.h"
#include "behaviortree_cpp/utils/locked_reference.hpp"
#include "behaviortree_cpp/utils/polymorphic_cast_registry.hpp"

namespace BT {

template <class T>
struct StampedValue {
  T value;
  Timestamp stamp;
};

class Blackboard : public lockstep_detail::BoardCasts,
                   public std::enable_shared_from_this<Blackboard> {
 public:
  using Ptr = std::shared_ptr<Blackboard>;

  // In a tree that runs, the value is what it was when the entry was asked for, or after the last
  // tick. What is written to `value` directly is not seen by the tree: getAnyLocked is for that.
  struct Entry {
    explicit Entry(const TypeInfo& type) : info(type), string_converter(type.converter()) {}
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

    Any value;
    TypeInfo info;
    StringConverter string_converter;
    mutable std::mutex entry_mutex;  // of all others
    std::uint64_t sequence_id = 0;   // how often it was written
    std::chrono::nanoseconds stamp{0};

    std::uint64_t lockstep_writes = 0;  // what the tree has counted
  };

  // An entry that it does not have, it looks for in the parent, by its remappings.
  static Ptr create(Ptr parent = {}) { return Ptr(new Blackboard(std::move(parent))); }
  virtual ~Blackboard() = default;
  Blackboard(const Blackboard&) = delete;
  Blackboard& operator=(const Blackboard&) = delete;

  // Throws when there is no entry, no value, or one of another type.
  template <class T>
  [[nodiscard]] T get(const std::string& key) const;
  // False when there is no value; throws when it has another type.
  template <class T>
  [[nodiscard]] bool get(const std::string& key, T& value) const;
  template <class T>
  [[nodiscard]] Expected<StampedValue<T>> getStamped(const std::string& key) const;
  template <class T>
  [[nodiscard]] Expected<Timestamp> getStamped(const std::string& key, T& value) const;

  // The first value gives an entry its type, but a text; another type throws, unless it is a number
  // of that value, or a text that is read as one.
  template <class T>
  void set(const std::string& key, const T& value);
  // An entry without a value. Throws when there is one of another type.
  template <class Key = std::string>
  void createEntry(const Key& key, const TypeInfo& type) {
    lockstep_open<Key>();
    lockstep_create(key, type);
  }
  // Removes an entry of this board.
  template <class Key = std::string>
  void unset(const Key& key) {
    lockstep_open<Key>();
    lockstep_unset(key);
  }

  // Null, false: there is no such entry.
  template <class Key = std::string>
  [[nodiscard]] std::shared_ptr<Entry> getEntry(const Key& key) const {
    lockstep_open<Key>();
    return lockstep_find(key).entry;
  }
  template <class Key = std::string>
  [[nodiscard]] const TypeInfo* entryInfo(const Key& key) const {
    const auto entry = getEntry(key);
    return entry == nullptr ? nullptr : &entry->info;
  }
  template <class Key = std::string>
  [[nodiscard]] AnyPtrLocked getAnyLocked(const Key& key) const {
    lockstep_open<Key>();
    return lockstep_locked(lockstep_find(key));
  }

  // Which keys are entries of the parent: one of them, or all that begin with no '_'.
  void addSubtreeRemapping(StringView internal, StringView external);
  void enableAutoRemapping(bool remapping);

  // The board of the main tree; outside of trees, the outermost.
  Blackboard* rootBlackboard();
  const Blackboard* rootBlackboard() const {
    return const_cast<Blackboard*>(this)->rootBlackboard();  // NOLINT: it is not changed
  }
  Ptr parent() const;

  // The names of its own entries; valid as long as these are there.
  template <class Key = StringView>
  [[nodiscard]] std::vector<Key> getKeys() const {
    lockstep_open<Key>();
    std::vector<Key> keys;
    lockstep_each([&keys](const std::string& key, Entry&) { keys.push_back(Key(key)); });
    return keys;
  }
  template <class Key = std::string>
  void clear() {
    for (const Key& key : getKeys<Key>()) lockstep_unset(key);
  }
  // Its own entries, with their types; what the other has beside them is removed.
  template <class Key = std::string>
  void cloneInto(Blackboard& other) const {
    lockstep_open<Key>();
    lockstep_clone_into(other);
  }
  template <class Key = std::string>
  void debugMessage() const {
    lockstep_open<Key>();
    lockstep_print();
  }

  // --- for the headers of lockstep ---------------------------------------------------------------

  struct LockstepFound {
    std::shared_ptr<Entry> entry = nullptr;                            // null: there is none
    std::shared_ptr<const lockstep_detail::BoardLink> link = nullptr;  // null: no tree has it
    std::string key = {};                                              // there
  };
  LockstepFound lockstep_find(const std::string& key) const;
  void lockstep_set(const std::string& key, Any value, TypeInfo type);
  // A value that has its type already, as a script gives it. How often it was written then.
  std::uint64_t lockstep_store(const std::string& key, Any value, const TypeInfo& type);
  void lockstep_create(const std::string& key, const TypeInfo& type);
  void lockstep_unset(const std::string& key);
  static AnyPtrLocked lockstep_locked(LockstepFound found);
  void lockstep_clone_into(Blackboard& other) const;
  void lockstep_print() const;
  // Visits its own entries.
  void lockstep_each(const std::function<void(const std::string& key, Entry& entry)>& visit) const;

  // Its entries become those of a board that runs, which has them already; and its own again.
  void lockstep_attach(std::shared_ptr<lockstep_detail::BoardFamily> family, std::uint32_t index);
  void lockstep_detach();
  bool lockstep_is_attached() const { return lockstep_link() != nullptr; }
  // Gives the tree what it holds itself, and what its parents hold: before leaves are made.
  void lockstep_give();
  // After a tick: entries that somebody has, and those of parents.
  void lockstep_refresh();
  // Before a tick: what parents have that is new.
  void lockstep_take_from_parents();
  // The one of a node, and of a board of a run.
  static Ptr lockstep_at(const lockstep_detail::Place& place);
  static Ptr lockstep_of(const std::shared_ptr<lockstep_detail::BoardFamily>& family,
                         std::uint32_t index);
  struct LockstepPort {
    Ptr board = nullptr;  // null: the port is bound to no entry
    std::string key = {};
  };
  static LockstepPort lockstep_of_port(const lockstep_detail::Place& place, std::uint32_t port);
  // Declares the C++ type of an entry which the tree knows only as its own type.
  void lockstep_declare(const std::string& key, const TypeInfo& type);

 private:
  explicit Blackboard(Ptr parent) : lockstep_parent_(std::move(parent)) {}

  class Locked;
  template <class Use>
  void lockstep_open() const {
    lockstep_detail::note_opening<Use>();
    if (lockstep_is_closed_) lockstep_refuse();
  }
  // To read an entry as a T. A plugin may know a type of objects by this alone.
  template <class T>
  void lockstep_open_as() const {
    lockstep_open<T>();
    if constexpr (lockstep_detail::port_type<T>() == LOCKSTEP_OBJECT) {
      lockstep_detail::object_type<T>();
    }
  }
  [[noreturn]] void lockstep_refuse() const;
  template <class T>
  std::optional<T> lockstep_value(const LockstepFound& found) const;

  std::shared_ptr<const lockstep_detail::BoardLink> lockstep_link() const {
    const std::lock_guard lock(lockstep_mutex_);
    return lockstep_link_;
  }
  std::shared_ptr<Entry> lockstep_own(const std::string& key) const;
  std::shared_ptr<Entry> lockstep_keep(const std::string& key, const TypeInfo& type) const;
  std::shared_ptr<Entry> lockstep_pull(const lockstep_detail::BoardLink& link,
                                       const std::string& key) const;
  static void lockstep_push(const LockstepFound& found);
  static void lockstep_assign(const LockstepFound& found, Any value, const TypeInfo& type,
                              bool is_new);
  // The value that an entry has now; others may write it at the same time.
  struct Seen {
    Any value;
    TypeInfo info;
    std::uint64_t writes;
  };
  static Seen lockstep_seen(const Entry& entry);
  // Where a key that is not its own is made.
  void lockstep_give_to_parents(const lockstep_detail::BoardLink& link);
  void lockstep_take(const std::string& key, LockstepFound found);
  LockstepFound lockstep_find_home(const std::string& key) const;
  LockstepFound lockstep_make(const std::string& key, const TypeInfo& type);
  std::string lockstep_remapped(const std::string& key) const;
  std::vector<std::pair<std::string, std::shared_ptr<Entry>>> lockstep_list() const;

  mutable std::mutex lockstep_mutex_;  // of all that follows; nothing is called under it
  mutable std::map<std::string, std::shared_ptr<Entry>, std::less<>> lockstep_entries_;
  std::shared_ptr<const lockstep_detail::BoardLink> lockstep_link_;  // null: no tree has it
  const Ptr lockstep_parent_;
  Ptr lockstep_root_;  // of the board of a SubTree, so that it stays
  std::map<std::string, std::string, std::less<>> lockstep_remaps_;
  bool lockstep_remaps_all_ = false;
  bool lockstep_is_closed_ = false;  // of a node that may not open entries

  // For the main tree: the entry of its parents, and how often each was written at the last
  // exchange.
  struct FromParent {
    LockstepFound outside = {};  // no entry: it is the tree's own
    std::uint64_t theirs = 0, ours = 0;
  };
  std::map<std::string, FromParent> lockstep_from_parents_;  // changed by the thread that ticks
};

}  // namespace BT

#include "behaviortree_cpp/lockstep/blackboard_functions.h"  // IWYU pragma: export
