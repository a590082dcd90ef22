// The call sites of the leaves of a set. A watchdog or a crash report may look at one whenever it
// likes, also when the set has gone: so their memory goes to later sets, never back to the system.
#pragma once

#include <string_view>
#include <vector>

#include "base/system/call_mark.h"

namespace lockstep::host {

// Blocks of T's that another owner had before, or new ones. A T is never anything else.
template <class T>
class RecycledMemory {
 public:
  RecycledMemory() = default;
  ~RecycledMemory();
  RecycledMemory(const RecycledMemory&) = delete;
  RecycledMemory& operator=(const RecycledMemory&) = delete;

  // So many in a row, which still have what they had.
  T* take(std::size_t count);
  static std::size_t bytes_of_all_owners();

 private:
  struct Block {
    T* items;
    unsigned bits;  // it has 2^bits items, and one behind them that nobody gets
  };
  struct Pool;
  static Pool& pool();

  std::vector<Block> blocks_;
  std::size_t used_ = 0;  // of the last block
  std::size_t items_ = 0;
};

class CallSites {
 public:
  // The path need not live on.
  const CallSite& add(std::string_view path, const CallSite::Origin& origin);
  // The memory of all sets, past ones too: it does not grow when sets come and go.
  static std::size_t bytes_of_all_sets();

 private:
  const char* keep(std::string_view text);

  RecycledMemory<CallSite> sites_;
  RecycledMemory<char> texts_;
};

}  // namespace lockstep::host
