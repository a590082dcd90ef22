// The functions of blackboard.h. Included by it.
#pragma once

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include "behaviortree_cpp/blackboard.h"

namespace BT {
namespace lockstep_detail {
LOCKSTEP_BTCPP_INLINE bool is_of_root(StringView key) {
  return key.size() > 1 && key.front() == '@';
}

LOCKSTEP_BTCPP_INLINE std::chrono::nanoseconds stamp_now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

// A number has the C++ type of its entry, and stays whole or real as it is.
LOCKSTEP_BTCPP_INLINE Any as_declared(const TypeInfo& info, Any value) {
  if (!value.isNumber() || number_of(info.type(), value).empty()) return value;
  Any typed(info.type());
  value.copyInto(typed);
  return typed;
}

// Takes the value of the tree if it is new. Under the locks of both.
LOCKSTEP_BTCPP_INLINE void refresh(Blackboard::Entry& entry, const lockstep_entry_value& value) {
  if (!entry.info.isStronglyTyped()) {
    const TypeInfo type = type_of_entry(value);
    if (type.isStronglyTyped()) entry.info = type;
  }
  const bool is_known = entry.lockstep_writes == value.writes &&
                        (value.type == 0 ? entry.value.empty() : is_same_value(entry.value, value));
  if (is_known) return;
  entry.value = as_declared(entry.info, value_of(value));
  entry.lockstep_writes = value.writes;
  entry.sequence_id = static_cast<std::uint32_t>(value.writes);
  entry.stamp = stamp_now();
}

LOCKSTEP_BTCPP_INLINE std::string no_value(const std::string& key) {
  return StrCat("nothing has written the entry '", key, "'");
}

}  // namespace lockstep_detail
LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_refuse() const {
  throw RuntimeError(
      "entries cannot be used by their names here: in an isolated plugin, or in a tree of "
      "lockstep's own language; use a port");
}

LOCKSTEP_BTCPP_INLINE std::shared_ptr<Blackboard::Entry> Blackboard::lockstep_own(
    const std::string& key) const {
  if (lockstep_detail::is_of_root(key)) return nullptr;
  const std::lock_guard lock(lockstep_mutex_);
  const auto found = lockstep_entries_.find(key);
  return found == lockstep_entries_.end() ? nullptr : found->second;
}

LOCKSTEP_BTCPP_INLINE std::shared_ptr<Blackboard::Entry> Blackboard::lockstep_keep(
    const std::string& key, const TypeInfo& type) const {
  const std::lock_guard lock(lockstep_mutex_);
  auto& kept = lockstep_entries_[key];
  if (kept == nullptr) kept = std::make_shared<Entry>(type);
  return kept;
}

LOCKSTEP_BTCPP_INLINE std::vector<std::pair<std::string, std::shared_ptr<Blackboard::Entry>>>
Blackboard::lockstep_list() const {
  const std::lock_guard lock(lockstep_mutex_);
  return {lockstep_entries_.begin(), lockstep_entries_.end()};
}

// Takes the value of an entry that the tree has on this board. An entry that somebody has locked
// stays as it is.
LOCKSTEP_BTCPP_INLINE std::shared_ptr<Blackboard::Entry> Blackboard::lockstep_pull(
    const lockstep_detail::BoardLink& link, const std::string& key) const {
  const std::lock_guard lock(link);
  lockstep_entry_value value{};
  value.struct_size = sizeof value;
  if (!link.read(key, value)) {
    const std::lock_guard own(lockstep_mutex_);
    if (!link.is_over()) lockstep_entries_.erase(key);
    const auto last = lockstep_entries_.find(key);
    return last == lockstep_entries_.end() ? nullptr : last->second;
  }
  auto entry = lockstep_keep(key, lockstep_detail::type_of_entry(value));
  const std::unique_lock held(entry->entry_mutex, std::try_to_lock);
  if (held) lockstep_detail::refresh(*entry, value);
  return entry;
}

// The tree gets what the entry has. Under the locks of both.
LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_push(const LockstepFound& found) {
  if (found.link == nullptr) return;
  Entry& entry = *found.entry;
  lockstep_detail::EntryValue value;
  lockstep_detail::declare(entry.info, value);
  if (!lockstep_detail::describe(entry.value, value) || !found.link->write(found.key, value)) {
    if (found.link->is_over()) return;
    throw LogicError("the entry '", found.key, "' does not take a value of type ",
                     lockstep_detail::readable(entry.value.type()));
  }
  lockstep_entry_value written{};
  written.struct_size = sizeof written;
  if (!found.link->read(found.key, written)) return;
  entry.lockstep_writes = written.writes;
  entry.sequence_id = static_cast<std::uint32_t>(written.writes);
}

LOCKSTEP_BTCPP_INLINE Blackboard::LockstepFound Blackboard::lockstep_find(
    const std::string& key) const {
  if (lockstep_is_closed_) return {};
  if (const auto link = lockstep_link()) {
    const auto home = link->home(key);
    if (home.board != link->index()) {
      return lockstep_of(link->family(), home.board)->lockstep_find(std::string(home.key));
    }
    std::string name(home.key);
    if (auto entry = lockstep_pull(*link, name)) return {std::move(entry), link, std::move(name)};
    if (lockstep_detail::is_of_root(name)) return rootBlackboard()->lockstep_find(name.substr(1));
  } else if (lockstep_detail::is_of_root(key)) {
    return rootBlackboard()->lockstep_find(key.substr(1));
  } else if (auto entry = lockstep_own(key)) {
    return {std::move(entry), nullptr, key};
  }
  const std::string outside = lockstep_remapped(key);
  return outside.empty() ? LockstepFound{} : lockstep_parent_->lockstep_find(outside);
}

// "": it is no entry of the parent.
LOCKSTEP_BTCPP_INLINE std::string Blackboard::lockstep_remapped(const std::string& key) const {
  if (lockstep_parent_ == nullptr) return {};
  const std::lock_guard lock(lockstep_mutex_);
  const auto found = lockstep_remaps_.find(key);
  if (found != lockstep_remaps_.end()) return found->second;
  return lockstep_remaps_all_ && !StartWith(key, '_') ? key : std::string();
}

LOCKSTEP_BTCPP_INLINE Blackboard::LockstepFound Blackboard::lockstep_make(const std::string& key,
                                                                          const TypeInfo& type) {
  const auto link = lockstep_link();
  return {lockstep_keep(key, type), link, key};
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_assign(const LockstepFound& found, Any value,
                                                       const TypeInfo& type, bool is_new) {
  const Locked lock(found);
  Entry& entry = *found.entry;
  const Any before = entry.value;
  const TypeInfo info_before = entry.info;
  const bool is_any = type.type() == typeid(Any);
  const bool is_strong = entry.info.isStronglyTyped();
  if (is_new || (is_any && (!is_strong || entry.info.type() == value.type()))) {
    entry.value = std::move(value);
  } else if (!is_strong) {
    entry.info = type;
    entry.string_converter = type.converter();
    entry.value = std::move(value);
  } else {
    if (entry.info.type() != type.type() && entry.info.type() != value.type()) {
      Any fitting;
      if (value.isString()) {
        try {
          fitting = entry.info.parseString(value.cast<std::string>());
        } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): it stays empty
        }
      } else {
        fitting = lockstep_detail::number_of(entry.info.type(), value);
      }
      if (fitting.empty()) {
        throw LogicError("Blackboard::set: the entry '", found.key, "' has the type [",
                         entry.info.typeName(), "], which does not change; this value is of type [",
                         type.typeName(), "]");
      }
      value = std::move(fitting);
    }
    if (entry.value.empty()) {
      entry.value = std::move(value);
    } else {
      value.copyInto(entry.value);
    }
  }
  ++entry.sequence_id;
  entry.stamp = lockstep_detail::stamp_now();
  try {
    lockstep_push(found);
  } catch (...) {
    --entry.sequence_id;
    entry.value = before;
    entry.info = info_before;
    throw;
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_set(const std::string& key, Any value,
                                                    TypeInfo type) {
  if (lockstep_is_closed_) lockstep_refuse();
  const auto link = lockstep_link();
  if (link != nullptr) {
    const auto home = link->home(key);
    if (home.board != link->index() || home.key.size() != key.size()) {
      return lockstep_of(link->family(), home.board)
          ->lockstep_set(std::string(home.key), std::move(value), std::move(type));
    }
  }
  auto entry = link != nullptr ? lockstep_pull(*link, key) : lockstep_own(key);
  if (entry != nullptr) return lockstep_assign({entry, link, key}, std::move(value), type, false);
  if (lockstep_detail::is_of_root(key)) {
    return rootBlackboard()->lockstep_set(key.substr(1), std::move(value), std::move(type));
  }
  const std::string outside = lockstep_remapped(key);
  if (!outside.empty()) {
    return lockstep_parent_->lockstep_set(outside, std::move(value), std::move(type));
  }
  // A text gives no type: it may be read as one of any.
  if (type.type() == typeid(Any)) {
    type = TypeInfo::lockstep_of_number(value);
  } else if (type.type() == typeid(std::string)) {
    type = {};
  }
  const LockstepFound made = lockstep_make(key, type);
  try {
    lockstep_assign(made, std::move(value), type, true);
  } catch (...) {
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_entries_.erase(key);
    throw;
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_create(const std::string& key,
                                                       const TypeInfo& type) {
  if (lockstep_is_closed_) lockstep_refuse();
  const auto link = lockstep_link();
  if (link != nullptr) {
    const auto home = link->home(key);
    if (home.board != link->index() || home.key.size() != key.size()) {
      return lockstep_of(link->family(), home.board)->lockstep_create(std::string(home.key), type);
    }
  }
  auto entry = link != nullptr ? lockstep_pull(*link, key) : lockstep_own(key);
  if (entry == nullptr) {
    if (lockstep_detail::is_of_root(key)) {
      return rootBlackboard()->lockstep_create(key.substr(1), type);
    }
    const std::string outside = lockstep_remapped(key);
    if (!outside.empty()) return lockstep_parent_->lockstep_create(outside, type);
    const LockstepFound made = lockstep_make(key, type);
    const Locked lock(made);
    return lockstep_push(made);
  }
  const std::lock_guard lock(entry->entry_mutex);
  const TypeInfo& before = entry->info;
  if (before.isStronglyTyped() && type.isStronglyTyped() && before.type() != type.type()) {
    throw LogicError("Blackboard::createEntry: the entry '", key, "' has the type [",
                     before.typeName(), "] already, not [", type.typeName(), "]");
  }
}

LOCKSTEP_BTCPP_INLINE std::uint64_t Blackboard::lockstep_store(const std::string& key, Any value,
                                                               const TypeInfo& type) {
  auto found = lockstep_find(key);
  if (found.entry == nullptr) {
    lockstep_create(key, type);
    found = lockstep_find(key);
  }
  const Locked lock(found);
  Entry& entry = *found.entry;
  if (!entry.info.isStronglyTyped() && type.isStronglyTyped()) entry.info = type;
  entry.value = lockstep_detail::as_declared(entry.info, std::move(value));
  ++entry.sequence_id;
  entry.stamp = lockstep_detail::stamp_now();
  lockstep_push(found);
  return entry.sequence_id;
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_unset(const std::string& key) {
  if (lockstep_is_closed_) lockstep_refuse();
  if (const auto link = lockstep_link()) link->unset(key);
  const std::lock_guard lock(lockstep_mutex_);
  lockstep_entries_.erase(key);
}

LOCKSTEP_BTCPP_INLINE AnyPtrLocked Blackboard::lockstep_locked(LockstepFound found) {
  if (found.entry == nullptr) return {};
  Any* const value = &found.entry->value;
  auto lock = std::make_shared<Locked>(found);
  return {value, [lock, found = std::move(found)](bool may_have_changed) {
            if (!may_have_changed || found.entry->value.empty()) return;
            ++found.entry->sequence_id;
            found.entry->stamp = lockstep_detail::stamp_now();
            try {
              lockstep_push(found);
            } catch (...) {  // NOLINT(bugprone-empty-catch): the tree keeps what it had
            }
          }};
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_each(
    const std::function<void(const std::string& key, Entry& entry)>& visit) const {
  if (const auto link = lockstep_link()) {
    for (const std::string& key : link->keys()) lockstep_pull(*link, key);
  }
  std::vector<std::pair<const std::string*, std::shared_ptr<Entry>>> all;
  {
    const std::lock_guard lock(lockstep_mutex_);
    for (const auto& [key, entry] : lockstep_entries_) all.emplace_back(&key, entry);
  }
  for (const auto& [key, entry] : all) {
    if (!lockstep_detail::is_of_root(*key)) visit(*key, *entry);
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_clone_into(Blackboard& other) const {
  struct Copy {
    std::string key;
    TypeInfo info;
    Any value;
  };
  std::vector<Copy> copies;
  const auto link = lockstep_link();
  lockstep_each([&copies](const std::string& key, Entry& entry) {
    const std::lock_guard lock(entry.entry_mutex);
    copies.push_back({key, entry.info, entry.value});
  });
  std::vector<std::string> rest;
  other.lockstep_each([&](const std::string& key, Entry&) {
    const auto is_it = [&key](const Copy& copy) { return copy.key == key; };
    if (std::none_of(copies.begin(), copies.end(), is_it)) rest.push_back(key);
  });
  for (const std::string& key : rest) other.lockstep_unset(key);
  const auto to = other.lockstep_link();
  for (Copy& copy : copies) {
    const LockstepFound made{other.lockstep_keep(copy.key, copy.info), to, copy.key};
    const Locked lock(made);
    made.entry->info = copy.info;
    made.entry->value = std::move(copy.value);
    ++made.entry->sequence_id;
    made.entry->stamp = lockstep_detail::stamp_now();
    lockstep_push(made);
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_print() const {
  lockstep_each([](const std::string& key, Entry& entry) {
    const std::lock_guard lock(entry.entry_mutex);
    std::cout << key << " (" << entry.info.typeName() << ")"
              << (entry.value.empty() ? " -> [empty]" : "") << std::endl;
  });
  std::map<std::string, std::string, std::less<>> remaps;
  {
    const std::lock_guard lock(lockstep_mutex_);
    remaps = lockstep_remaps_;
  }
  for (const auto& [internal, external] : remaps) {
    std::cout << internal << " is '" << external << "' of the parent";
    if (const auto found = lockstep_find(internal); found.entry != nullptr) {
      std::cout << " (" << found.entry->info.typeName() << ")";
    }
    std::cout << std::endl;
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::addSubtreeRemapping(StringView internal,
                                                           StringView external) {
  if (lockstep_link() != nullptr) {
    throw LogicError(
        "Blackboard::addSubtreeRemapping: this board is of a tree that runs, whose "
        "XML says which entries are remapped");
  }
  const std::lock_guard lock(lockstep_mutex_);
  lockstep_remaps_[std::string(internal)] = external;
}

LOCKSTEP_BTCPP_INLINE void Blackboard::enableAutoRemapping(bool remapping) {
  if (lockstep_link() != nullptr && remapping != lockstep_remaps_all_) {
    throw LogicError(
        "Blackboard::enableAutoRemapping: this board is of a tree that runs: write "
        "_autoremap=\"true\" on its SubTree");
  }
  const std::lock_guard lock(lockstep_mutex_);
  lockstep_remaps_all_ = remapping;
}

LOCKSTEP_BTCPP_INLINE Blackboard* Blackboard::rootBlackboard() {
  if (lockstep_root_ != nullptr) return lockstep_root_->rootBlackboard();
  return lockstep_parent_ != nullptr ? lockstep_parent_->rootBlackboard() : this;
}

LOCKSTEP_BTCPP_INLINE Blackboard::Ptr Blackboard::parent() const {
  const auto link = lockstep_link();
  if (link == nullptr || link->index() == 0) return lockstep_parent_;
  return lockstep_of(link->family(), link->parent());
}

LOCKSTEP_BTCPP_INLINE Blackboard::Ptr Blackboard::lockstep_of(
    const std::shared_ptr<lockstep_detail::BoardFamily>& family, std::uint32_t index) {
  Ptr root = index == 0 ? nullptr : lockstep_of(family, 0);
  const std::lock_guard lock(family->mutex);
  auto& kept = family->boards[index];
  Ptr board = kept.lock();
  if (board == nullptr) {
    board = Ptr(new Blackboard({}));
    board->lockstep_link_ =
        std::make_shared<lockstep_detail::BoardLink>(family, family->root.at(index));
    board->lockstep_root_ = std::move(root);
    kept = board;
  }
  return board;
}

LOCKSTEP_BTCPP_INLINE Blackboard::Ptr Blackboard::lockstep_at(const lockstep_detail::Place& place) {
  const auto* const table =
      static_cast<const lockstep_boards*>(place.host->get_extension(LOCKSTEP_BOARDS));
  lockstep_board* const it = table == nullptr ? nullptr : table->of(place.caller);
  if (it == nullptr) {
    static const Ptr closed = [] {
      Ptr board(new Blackboard({}));
      board->lockstep_is_closed_ = true;
      return board;
    }();
    return closed;
  }
  const lockstep_detail::BoardHandle board(*table, it);
  return lockstep_of(lockstep_detail::BoardFamily::of(board.at(0)), table->index(it));
}

LOCKSTEP_BTCPP_INLINE Blackboard::LockstepPort Blackboard::lockstep_of_port(
    const lockstep_detail::Place& place, std::uint32_t port) {
  const auto* const table =
      static_cast<const lockstep_boards*>(place.host->get_extension(LOCKSTEP_BOARDS));
  if (table == nullptr) return {};
  const char* name = nullptr;
  std::size_t length = 0;
  const std::uint32_t index = table->of_port(place.caller, port, &name, &length);
  if (index == UINT32_MAX) return {};
  const lockstep_detail::BoardHandle board(*table, table->of(place.caller));
  return {lockstep_of(lockstep_detail::BoardFamily::of(board.at(0)), index), {name, length}};
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_attach(
    std::shared_ptr<lockstep_detail::BoardFamily> family, std::uint32_t index) {
  {
    const std::lock_guard lock(family->mutex);
    family->boards[index] = weak_from_this();
  }
  const std::lock_guard lock(lockstep_mutex_);
  if (lockstep_link_ != nullptr && !lockstep_link_->is_over()) {
    throw LogicError("this BT::Blackboard is that of another tree already");
  }
  auto board = family->root.at(index);
  lockstep_link_ =
      std::make_shared<lockstep_detail::BoardLink>(std::move(family), std::move(board));
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_detach() {
  const auto link = lockstep_link();
  if (link == nullptr) return;
  std::vector<Ptr> all;
  {
    const std::lock_guard lock(link->family()->mutex);
    for (const auto& [index, board] : link->family()->boards) {
      if (Ptr it = board.lock()) all.push_back(std::move(it));
    }
  }
  for (const Ptr& board : all) board->lockstep_each([](const std::string&, Entry&) {});
  for (const Ptr& board : all) {
    const std::lock_guard lock(board->lockstep_mutex_);
    board->lockstep_link_.reset();
    board->lockstep_root_.reset();
    board->lockstep_from_parents_.clear();
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_give() {
  const auto link = lockstep_link();
  const auto all = lockstep_list();
  {
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_from_parents_.clear();
    for (const auto& [key, entry] : all) lockstep_from_parents_[key] = {};  // its own
  }
  for (const auto& [key, entry] : all) {
    const std::lock_guard lock(entry->entry_mutex);
    lockstep_push({entry, link, key});
  }
  lockstep_take_from_parents();
}

// Not the copy that a tree has of what its parents hold.
LOCKSTEP_BTCPP_INLINE Blackboard::LockstepFound Blackboard::lockstep_find_home(
    const std::string& key) const {
  {
    const std::lock_guard lock(lockstep_mutex_);
    const auto copied = lockstep_from_parents_.find(key);
    const bool is_copied = copied != lockstep_from_parents_.end();
    if (is_copied && copied->second.outside.entry != nullptr) return copied->second.outside;
  }
  return lockstep_find(key);
}

// Takes the value of a parent if it is new.
LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_take(const std::string& key, LockstepFound found) {
  if (found.entry == nullptr) return;
  const bool is_new = lockstep_from_parents_.count(key) == 0;
  if (is_new) {
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_from_parents_[key].outside = std::move(found);
  }
  FromParent& it = lockstep_from_parents_.at(key);
  if (it.outside.entry == nullptr) return;
  Any value;
  TypeInfo info;
  {
    const Locked lock(it.outside);
    const Entry& entry = *it.outside.entry;
    if (!is_new && entry.sequence_id == it.theirs) return;
    it.theirs = entry.sequence_id;
    value = entry.value;
    info = entry.info;
  }
  const LockstepFound own{lockstep_keep(key, info), lockstep_link(), key};
  const Locked lock(own);
  own.entry->info = info;
  own.entry->value = std::move(value);
  lockstep_push(own);
  it.ours = own.entry->lockstep_writes;
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_take_from_parents() {
  if (lockstep_parent_ == nullptr) return;
  Blackboard* const root = lockstep_parent_->rootBlackboard();
  root->lockstep_each(
      [&](const std::string& key, Entry&) { lockstep_take('@' + key, root->lockstep_find(key)); });
  for (const Blackboard* it = lockstep_parent_.get(); lockstep_remaps_all_ && it != nullptr;
       it = it->lockstep_parent_.get()) {
    it->lockstep_each([&](const std::string& key, Entry&) {
      if (!StartWith(key, '_')) lockstep_take(key, lockstep_parent_->lockstep_find_home(key));
    });
  }
  for (const auto& [internal, external] : lockstep_remaps_) {
    lockstep_take(internal, lockstep_parent_->lockstep_find_home(external));
  }
}

LOCKSTEP_BTCPP_INLINE Blackboard::Seen Blackboard::lockstep_seen(const Entry& entry) {
  const std::lock_guard lock(entry.entry_mutex);
  return {entry.value, entry.info, entry.lockstep_writes};
}

// Gives parents the values that the tree has written.
LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_give_to_parents(
    const lockstep_detail::BoardLink& link) {
  if (lockstep_parent_ == nullptr) return;
  for (const std::string& key : link.keys()) {
    const bool is_theirs =
        lockstep_detail::is_of_root(key) || (lockstep_remaps_all_ && !StartWith(key, '_'));
    if (!is_theirs || lockstep_from_parents_.count(key) != 0) continue;
    const auto entry = lockstep_pull(link, key);
    if (entry == nullptr) continue;
    const Seen own = lockstep_seen(*entry);
    if (own.value.empty()) continue;
    const std::uint64_t theirs = lockstep_parent_->lockstep_store(key, own.value, own.info);
    auto outside = lockstep_parent_->lockstep_find(key);
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_from_parents_[key] = {std::move(outside), theirs, own.writes};
  }
  for (auto& [key, known] : lockstep_from_parents_) {
    if (known.outside.entry == nullptr) continue;
    const auto entry = lockstep_pull(link, key);
    if (entry == nullptr) continue;
    Seen own = lockstep_seen(*entry);
    if (own.writes == known.ours) continue;
    known.ours = own.writes;
    const Locked lock(known.outside);
    Entry& outside = *known.outside.entry;
    outside.value = std::move(own.value);
    outside.stamp = lockstep_detail::stamp_now();
    ++outside.sequence_id;
    lockstep_push(known.outside);
    known.theirs = outside.sequence_id;
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_refresh() {
  const auto link = lockstep_link();
  if (link == nullptr) return;
  lockstep_give_to_parents(*link);
  std::vector<Ptr> all;
  {
    const std::lock_guard lock(link->family()->mutex);
    for (const auto& [index, board] : link->family()->boards) {
      if (Ptr it = board.lock()) all.push_back(std::move(it));
    }
  }
  for (const Ptr& board : all) {
    const auto own = board->lockstep_link();
    std::vector<std::string> held;
    {
      const std::lock_guard lock(board->lockstep_mutex_);
      for (const auto& [key, entry] : board->lockstep_entries_) {
        if (entry.use_count() > 1) held.push_back(key);
      }
    }
    for (const std::string& key : held) board->lockstep_pull(*own, key);
  }
}

LOCKSTEP_BTCPP_INLINE void Blackboard::lockstep_declare(const std::string& key,
                                                        const TypeInfo& type) {
  const auto link = lockstep_link();
  if (link == nullptr || !type.isStronglyTyped()) return;
  const auto home = link->home(key);
  if (home.board != link->index()) {
    return lockstep_of(link->family(), home.board)->lockstep_declare(std::string(home.key), type);
  }
  const auto entry = lockstep_keep(std::string(home.key), type);
  const std::lock_guard lock(entry->entry_mutex);
  if (!entry->info.isStronglyTyped()) {
    entry->info = type;
    entry->string_converter = type.converter();
  }
}

}  // namespace BT
