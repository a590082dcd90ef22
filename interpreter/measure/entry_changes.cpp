#include "measure/entry_changes.h"

#include <utility>

namespace lockstep {
namespace {

// False: it is too long.
bool put_short(const Value& value, std::string& text) {
  text.clear();
  // A number of a list has two bytes at least, with its separator.
  const auto* list = std::get_if<std::vector<double>>(&value);
  if (list != nullptr && list->size() > EntryChanges::kLongest) return false;
  const auto* words = std::get_if<std::string>(&value);
  if (words != nullptr && words->size() > EntryChanges::kLongest) return false;
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
}

EntryChanges::EntryChanges(std::vector<std::uint32_t> slots) {
  for (const std::uint32_t slot : slots) {
    Watched& watched = watched_.emplace_back(Watched{.slot = slot});
    watched.text.reserve(kNumber);
    watched.next.reserve(kNumber);
  }
  changes_.reserve(slots.size());
}

std::span<const EntryChange> EntryChanges::changes(const Blackboard& board) {
  changes_.clear();
  for (std::uint32_t number = 0; number < watched_.size(); ++number) {
    Watched& watched = watched_[number];
    const Entry& entry = board.entries[watched.slot];
    if (watched.writes == entry.writes) continue;
    if (std::holds_alternative<NoValue>(entry.value)) continue;
    // What is too long may be another value: each time it is written it is shown.
    const bool is_short = put_short(entry.value, watched.next);
    if (is_short && watched.has_text && watched.next == watched.text) {
      watched.writes = entry.writes;
    } else {
      changes_.push_back({.entry = number, .text = is_short ? &watched.next : nullptr});
    }
  }
  board_ = &board;
  return changes_;
}

void EntryChanges::keep() {
  for (const EntryChange& change : changes_) {
    Watched& watched = watched_[change.entry];
    watched.writes = board_->entries[watched.slot].writes;
    watched.has_text = change.text != nullptr;
    std::swap(watched.text, watched.next);
  }
  changes_.clear();
}

}  // namespace lockstep
