// The names of a run's entries. Each tree has a separate board: the main tree, and each use of a
// SubTree. Nearly all keys are resolved when a tree is loaded; these are for those that are known
// only while it runs.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace lockstep::host {

struct Board {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t parent = kNone;  // of a SubTree: the board outside
  std::uint32_t node = 0;        // the SubTree
  bool autoremap = false;
  // The board of the main tree: "@key" names another entry than "key", one of a board outside.
  bool has_outside = false;
  std::map<std::string, std::string, std::less<>> remapped = {};  // to a key outside
  std::set<std::string, std::less<>> own = {};  // keys that have a start value here
  std::map<std::string, std::uint32_t, std::less<>> entries = {};  // of keys that are at home here
};

// The board where a key is at home, and its name there. "@key" is one of the main tree, board 0:
// "key", or "@key" if there is a board outside.
struct Home {
  std::uint32_t board;
  std::string_view key;
};

inline Home home_of(std::span<const Board> boards, std::uint32_t board, std::string_view key) {
  while (true) {
    if (key.size() > 1 && key.starts_with('@')) {
      return {0, boards[0].has_outside ? key : key.substr(1)};
    }
    const Board& it = boards[board];
    if (it.parent == Board::kNone || it.own.contains(key)) return {board, key};
    const auto remapped = it.remapped.find(key);
    const bool passes_on = it.autoremap && !key.starts_with('_');
    if (remapped == it.remapped.end() && !passes_on) return {board, key};
    if (remapped != it.remapped.end()) key = remapped->second;
    board = it.parent;
  }
}

}  // namespace lockstep::host
