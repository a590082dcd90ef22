// Names with a number each, in one flat table whose size is known beforehand. For compile.cpp,
// which makes a table for each node's children.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep {

class NameTable {
 public:
  struct Entry {
    std::string_view name;
    std::uint32_t number = 0;  // 0: nobody is here
  };

  // For up to `names` names. `memory` is used again from table to table, so that it is allocated
  // once.
  NameTable(std::size_t names, std::vector<Entry>& memory) : entries_(memory) {
    entries_.assign(std::bit_ceil(2 * names), Entry());
    mask_ = entries_.size() - 1;
  }

  // Where the number of `name` is, which is `number` (not 0) when the name is new.
  std::pair<std::uint32_t*, bool> insert(std::string_view name, std::uint32_t number) {
    std::size_t at = std::hash<std::string_view>()(name) & mask_;
    while (entries_[at].number != 0 && entries_[at].name != name) at = (at + 1) & mask_;
    Entry& entry = entries_[at];
    const bool is_new = entry.number == 0;
    if (is_new) entry = {name, number};
    return {&entry.number, is_new};
  }

 private:
  std::vector<Entry>& entries_;
  std::size_t mask_;
};

}  // namespace lockstep
