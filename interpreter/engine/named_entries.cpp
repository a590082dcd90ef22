#include "engine/named_entries.h"

namespace lockstep::host {

Entry* NamedEntries::find(const Home& home) {
  const auto& known = boards_[home.board].entries;
  if (const auto slot = known.find(home.key); slot != known.end()) return &slots_[slot->second];
  auto& made = made_[home.board];
  const auto found = made.find(home.key);
  return found == made.end() ? nullptr : &found->second;
}

Entry* NamedEntries::find(std::uint32_t board, std::string_view key) {
  return find(home_of(boards_, board, key));
}

Entry& NamedEntries::at(std::uint32_t board, std::string_view key) {
  const Home home = home_of(boards_, board, key);
  if (Entry* const found = find(home)) return *found;
  Entry& entry = made_[home.board][std::string(home.key)];
  unset_entry(entry);
  return entry;
}

Entry* NamedEntries::own(std::uint32_t board, std::string_view key) {
  const bool is_own = !key.starts_with('@') && home_of(boards_, board, key).board == board;
  return is_own ? &at(board, key) : nullptr;
}

void NamedEntries::restore(const Made& from) {
  reset();
  for (std::size_t board = 0; board < from.size(); ++board) {
    for (const auto& [key, entry] : from[board]) made_[board][key] = entry;
  }
}

void NamedEntries::forget_objects() {
  for (auto& made : made_) {
    for (auto& [key, entry] : made) entry.forget_object();
  }
}

void NamedEntries::reset() {
  for (auto& made : made_) {
    for (auto& [key, entry] : made) unset_entry(entry);
  }
}

}  // namespace lockstep::host
