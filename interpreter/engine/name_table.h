// Names with a number each, in one flat table that grows with the names that are different: most
// nodes of a large tree may have no name of their own. For compile.cpp, which makes a table for
// each node's children.
#pragma once

#include <algorithm>
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
    std::uint32_t hash = 0;
  };

  // For up to `names` names. `memory` is used again from table to table, so that a small one
  // allocates nothing.
  NameTable(std::size_t names, std::vector<Entry>& memory) : most_(names), entries_(memory) {
    entries_.assign(std::bit_ceil(2 * std::min(names, kFew)), Entry());
  }

  // Where the number of `name` is, which is `number` (not 0) when the name is new. The pointer is
  // good until the next call.
  std::pair<std::uint32_t*, bool> insert(std::string_view name, std::uint32_t number) {
    const auto hash = static_cast<std::uint32_t>(std::hash<std::string_view>()(name));
    std::size_t at = slot(hash);
    while (entries_[at].number != 0 && !(entries_[at].hash == hash && entries_[at].name == name))
      at = next(at);
    if (entries_[at].number != 0) return {&entries_[at].number, false};
    if (2 * ++size_ > entries_.size()) {
      grow();
      at = free_slot(hash);
    }
    entries_[at] = {name, number, hash};
    return {&entries_[at].number, true};
  }

 private:
  static constexpr std::size_t kFew = 16;

  std::size_t slot(std::uint32_t hash) const { return hash & (entries_.size() - 1); }
  std::size_t next(std::size_t at) const { return (at + 1) & (entries_.size() - 1); }
  std::size_t free_slot(std::uint32_t hash) const {
    std::size_t at = slot(hash);
    while (entries_[at].number != 0) at = next(at);
    return at;
  }
  void grow() {
    std::vector<Entry> before(std::bit_ceil(2 * most_));
    before.swap(entries_);
    for (const Entry& entry : before)
      if (entry.number != 0) entries_[free_slot(entry.hash)] = entry;
  }

  std::size_t most_;
  std::vector<Entry>& entries_;
  std::size_t size_ = 0;
};

}  // namespace lockstep
