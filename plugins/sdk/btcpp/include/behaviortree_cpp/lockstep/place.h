// Where a node is: the host that calls it, and how the host names it.
#pragma once

#include <lockstep/leaf.h>
#include <lockstep/cpp/caller.hpp>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace BT::lockstep_detail {

struct Registration;

// A number for the thread that asks.
inline std::uintptr_t this_thread() {
#if defined(__GNUC__) && !defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
  return reinterpret_cast<std::uintptr_t>(__builtin_thread_pointer());
#else
  return reinterpret_cast<std::uintptr_t>(&errno);
#endif
}

struct Place {
  const lockstep_host* host = nullptr;
  const lockstep_caller* caller = nullptr;
  const lockstep_place* node = nullptr;
  const lockstep_children* children = nullptr;  // of a control node or decorator
  const Registration* registration = nullptr;   // of its type
  // By the index of the port: where its constant is, if it is a bool or a number. Null: an older
  // host does not tell.
  std::unique_ptr<const void*[]> constants;
  std::atomic<std::uintptr_t> ticking{};  // the thread that ticks it now; 0: none

  bool is_in_tick() const { return ticking.load(std::memory_order_relaxed) == this_thread(); }
  // The tree is ticked at once; from any thread. An older host cannot do that.
  void wake() const {
    constexpr std::size_t kSize = offsetof(lockstep_place, wake) + sizeof(lockstep_place::wake);
    if (node != nullptr && node->struct_size >= kSize) node->wake(caller);
  }
};

}  // namespace BT::lockstep_detail
