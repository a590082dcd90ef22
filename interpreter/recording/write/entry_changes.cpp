#include "recording/write/entry_changes.h"

#include <utility>

namespace lockstep {
namespace {

std::optional<std::string> short_text(const Value& value) {
  // A number of a list has two bytes at least, with its separator.
  const auto* list = std::get_if<std::vector<double>>(&value);
  if (list != nullptr && list->size() > EntryChanges::kLongest) return std::nullopt;
  const auto* words = std::get_if<std::string>(&value);
  if (words != nullptr && words->size() > EntryChanges::kLongest) return std::nullopt;
  std::string text = to_text(value);
  if (text.size() > EntryChanges::kLongest) return std::nullopt;
  return text;
}

}  // namespace

EntryChanges::EntryChanges(std::vector<std::uint32_t> slots) {
  for (const std::uint32_t slot : slots) watched_.push_back({.slot = slot});
}

std::span<const RecordedEntry> EntryChanges::changes(const Blackboard& board) {
  changes_.clear();
  for (std::uint32_t number = 0; number < watched_.size(); ++number) {
    Watched& watched = watched_[number];
    const Entry& entry = board.entries[watched.slot];
    if (watched.writes == entry.writes) continue;
    if (std::holds_alternative<std::monostate>(entry.value)) continue;
    auto text = short_text(entry.value);
    // A long value may be another one: who writes it again is shown again.
    if (watched.is_known && text && text == watched.value) {
      watched.writes = entry.writes;
      continue;
    }
    changes_.push_back({.entry = number, .value = std::move(text)});
  }
  board_ = &board;
  return changes_;
}

void EntryChanges::keep() {
  for (RecordedEntry& change : changes_) {
    Watched& watched = watched_[change.entry];
    watched.writes = board_->entries[watched.slot].writes;
    watched.value = std::move(change.value);
    watched.is_known = true;
  }
  changes_.clear();
}

}  // namespace lockstep
