#include "judge/measure/entry_changes.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {
namespace {

// The least size of a value as text, so that one that is far too long is not written.
template <class T>
std::size_t least_bytes(const T& /*scalar*/) {
  return 1;
}
std::size_t least_bytes(const std::string& text) {
  return text.size();
}
template <class T>
std::size_t least_bytes(const std::vector<T>& list) {
  std::size_t bytes = list.empty() ? 0 : list.size() - 1;
  for (const T& item : list) {
    if (bytes > EntryChanges::kLongest) break;
    bytes += least_bytes(item);
  }
  return bytes;
}

// False: it is too long.
bool put_short(const Value& value, std::string& text) {
  text.clear();
  if (std::visit([](const auto& it) { return least_bytes(it); }, value) > EntryChanges::kLongest) {
    return false;
  }
  append_text(value, text);
  return text.size() <= EntryChanges::kLongest;
}

}  // namespace

void EntryState::set(const std::string* value, std::uint64_t tick) {
  is_long = value == nullptr;
  if (is_long) {
    text.clear();
  } else {
    text = *value;
  }
  changed = tick;
  is_older = false;
}

EntryChanges::EntryChanges(const std::vector<std::uint32_t>& slots) {
  for (const std::uint32_t slot : slots) {
    Watched& watched = watched_.emplace_back(Watched{.slot = slot});
    watched.text.reserve(kNumber);
    watched.next.reserve(kNumber);
    watched.given.reserve(kNumber);
  }
  changes_.reserve(slots.size());
  values_.reserve(slots.size());
}

void EntryChanges::begin(std::span<const Entry> entries, std::span<const std::uint32_t> set) {
  for (Watched& it : watched_) {
    const Entry& entry = entries[it.slot];
    it.writes_of_tick = entry.changes();
    it.is_set = entry.has_value() && std::ranges::find(set, it.slot) != set.end();
    if (it.is_set) it.has_given = put_short(entry.value(), it.given);
  }
}

void EntryChanges::before_tick(std::span<const Entry> entries) {
  for (Watched& it : watched_) {
    const Entry& entry = entries[it.slot];
    if (entry.changes() == it.writes_of_tick) continue;
    it.writes_of_tick = entry.changes();
    it.is_set = entry.has_value();
    if (it.is_set) it.has_given = put_short(entry.value(), it.given);
  }
}

std::span<const EntryChange> EntryChanges::changes(std::span<const Entry> entries) {
  changes_.clear();
  for (std::uint32_t number = 0; number < watched_.size(); ++number) {
    Watched& watched = watched_[number];
    const Entry& entry = entries[watched.slot];
    watched.writes_of_tick = entry.changes();
    if (watched.writes == entry.changes()) continue;
    if (!entry.has_value()) continue;
    // A text that is too long may be another value, so it is shown each time it is written.
    const bool is_short = put_short(entry.value(), watched.next);
    // For example, a button: it was set to true, and the tree has put it back to false.
    // Two texts that are too long may be the same.
    const bool is_other =
        is_short ? !watched.has_given || watched.next != watched.given : watched.has_given;
    const bool is_written_again = watched.is_set && is_other;
    const bool is_same = is_short && watched.has_text && watched.next == watched.text;
    if (is_same && !is_written_again) {
      watched.writes = entry.changes();
      watched.is_set = false;
    } else {
      changes_.push_back({.entry = number,
                          .text = is_short ? &watched.next : nullptr,
                          .is_set = watched.is_set,
                          .is_written_again = is_written_again,
                          .given = watched.has_given ? &watched.given : nullptr});
    }
  }
  entries_ = entries;
  return changes_;
}

std::span<const EntryChange> EntryChanges::values() {
  values_.clear();
  auto change = changes_.begin();
  for (std::uint32_t number = 0; number < watched_.size(); ++number) {
    const Watched& watched = watched_[number];
    if (change != changes_.end() && change->entry == number) {
      values_.push_back(*change++);
    } else if (watched.writes) {
      values_.push_back({.entry = number, .text = watched.has_text ? &watched.text : nullptr});
    }
  }
  return values_;
}

void EntryChanges::keep() {
  for (const EntryChange& change : changes_) {
    Watched& watched = watched_[change.entry];
    watched.writes = entries_[watched.slot].changes();
    watched.has_text = change.text != nullptr;
    watched.is_set = false;
    std::swap(watched.text, watched.next);
  }
  changes_.clear();
}

void EntryChanges::start_over() {
  for (Watched& watched : watched_) {
    watched.writes.reset();
    watched.has_text = false;
  }
}

}  // namespace lockstep::host
