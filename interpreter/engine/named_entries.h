// Entries of a run by names that are known only while it runs. A name that nothing in the tree uses
// gets an entry here, which stays where it is until the run's end.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/board.h"
#include "base/blackboard/entry.h"

namespace lockstep::host {

class NamedEntries {
 public:
  // `boards` and `slots`, the entries of the tree, must outlive this and stay where they are.
  NamedEntries(std::span<const Board> boards, std::span<Entry> slots)
      : boards_(boards), slots_(slots), made_(boards.size()) {}

  // The entry that `key` means on a board; it may be one that is not present. Allocates for a name
  // that is new.
  Entry& at(std::uint32_t board, std::string_view key);
  // The same; null: none was made, or used by the tree.
  Entry* find(std::uint32_t board, std::string_view key);
  // The same as `at`, if it belongs to that board; else null.
  Entry* own(std::uint32_t board, std::string_view key);
  // Calls `visit` with the key of each entry that is at home on the board, also of those that are
  // not present.
  template <class Visit>
  void each(std::uint32_t board, Visit visit) {
    for (const auto& [key, slot] : boards_[board].entries) visit(key, slots_[slot]);
    for (const auto& [key, entry] : made_[board]) visit(key, entry);
  }
  // Entries that were made here have none any more.
  void forget_objects();
  // As new, for the next run: those that were made here are not present.
  void reset();

  using Made = std::vector<std::map<std::string, Entry, std::less<>>>;  // of each board; none moves
  const Made& made() const { return made_; }
  // Those that are not in `from` are not present.
  void restore(const Made& from);

 private:
  Entry* find(const Home& home);

  std::span<const Board> boards_;
  std::span<Entry> slots_;
  Made made_;
};

}  // namespace lockstep::host
