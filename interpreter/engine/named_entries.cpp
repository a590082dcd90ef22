#include "engine/named_entries.h"

namespace lockstep::host {

Entry& NamedEntries::at(std::uint32_t board, std::string_view key) {
  const Home home = home_of(boards_, board, key);
  const auto& known = boards_[home.board].entries;
  if (const auto slot = known.find(home.key); slot != known.end()) return slots_[slot->second];
  auto& made = made_[home.board];
  if (const auto found = made.find(home.key); found != made.end()) return found->second;
  Entry& entry = made[std::string(home.key)];
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

void NamedEntries::reset() {
  for (auto& made : made_) {
    for (auto& [key, entry] : made) unset_entry(entry);
  }
}

}  // namespace lockstep::host
