// An allocator of numbers that are 0 and in memory that is not touched: for large tables of which
// few places are ever used.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>

namespace lockstep::host {

template <class T>
struct ZeroedMemory {
  static_assert(std::is_arithmetic_v<T>);
  using value_type = T;

  T* allocate(std::size_t count) {
    auto* const memory = static_cast<T*>(std::calloc(count, sizeof(T)));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  void construct(T*) {}  // it is 0

  friend bool operator==(const ZeroedMemory&, const ZeroedMemory&) { return true; }
};

}  // namespace lockstep::host
