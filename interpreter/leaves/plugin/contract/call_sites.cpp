#include "leaves/plugin/contract/call_sites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/core/diagnostics.h"
#include "base/system/mutex.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kSmallestBlock = 8, kLargestBlock = 16 << 10;  // items

bool is_plain(char it) {
  return it >= ' ' && it <= '~';
}

}  // namespace

template <class T>
struct RecycledMemory<T>::Pool {
  Mutex mutex;
  // By the bits of their sizes: those that nobody has, and how many there are in all.
  std::array<std::vector<T*>, 64> free LOCKSTEP_GUARDED_BY(mutex);
  std::array<std::size_t, 64> made LOCKSTEP_GUARDED_BY(mutex){};
};

// Never destroyed: threads outlive the end of main.
template <class T>
typename RecycledMemory<T>::Pool& RecycledMemory<T>::pool() {
  static auto& pool = *new Pool;
  return pool;
}

template <class T>
T* RecycledMemory<T>::take(std::size_t count) {
  if (blocks_.empty() || used_ + count > std::size_t{1} << blocks_.back().bits) {
    const std::size_t wanted = std::max(count, std::clamp(items_, kSmallestBlock, kLargestBlock));
    const auto bits = static_cast<unsigned>(std::bit_width(wanted - 1));
    blocks_.reserve(blocks_.size() + 1);
    Pool& all = pool();
    const Lock lock(all.mutex);
    auto& free = all.free[bits];
    if (free.empty()) {
      free.reserve(all.made[bits] + 1);  // so that giving it back needs no memory
      free.push_back(new T[(std::size_t{1} << bits) + 1]());
      ++all.made[bits];
    }
    blocks_.push_back({free.back(), bits});
    free.pop_back();
    used_ = 0;
    items_ += std::size_t{1} << bits;
  }
  T* const first = blocks_.back().items + used_;
  used_ += count;
  return first;
}

template <class T>
RecycledMemory<T>::~RecycledMemory() {
  Pool& all = pool();
  const Lock lock(all.mutex);
  for (const Block& block : blocks_) all.free[block.bits].push_back(block.items);
}

template <class T>
std::size_t RecycledMemory<T>::bytes_of_all_owners() {
  Pool& all = pool();
  const Lock lock(all.mutex);
  std::size_t bytes = 0;
  for (std::size_t bits = 0; bits < all.made.size(); ++bits) {
    bytes += all.made[bits] * ((std::size_t{1} << bits) + 1) * sizeof(T);
  }
  return bytes;
}

// A thread that still reads the text that was there finds an end: that of the block at the latest.
const char* CallSites::keep(std::string_view text) {
  char* const kept = texts_.take(text.size() + 1);
  std::memcpy(kept, text.data(), text.size());
  kept[text.size()] = '\0';
  return kept;
}

const CallSite& CallSites::add(std::string_view path, const CallSite::Origin& origin) {
  const char* const kept = keep(path);
  const bool is_shown_as_it_is = std::ranges::all_of(path, is_plain);
  CallSite& site = *sites_.take(1);
  site.path = kept;
  site.shown = is_shown_as_it_is ? kept : keep(printable(path));
  site.origin = &origin;
  return site;
}

std::size_t CallSites::bytes_of_all_sets() {
  return RecycledMemory<CallSite>::bytes_of_all_owners() +
         RecycledMemory<char>::bytes_of_all_owners();
}

template class RecycledMemory<CallSite>;
template class RecycledMemory<char>;

}  // namespace lockstep::host
