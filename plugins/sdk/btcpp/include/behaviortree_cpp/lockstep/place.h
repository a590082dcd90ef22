// Where a node is: the host that calls it, and how the host names it.
#pragma once

#include <lockstep/leaf.h>
#include <pthread.h>
#include <lockstep/cpp/caller.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace BT::lockstep_detail {

struct Registration;

struct Place {
  const lockstep_host* host = nullptr;
  const lockstep_caller* caller = nullptr;
  const lockstep_place* node = nullptr;
  const lockstep_children* children = nullptr;  // of a control node or decorator
  const Registration* registration = nullptr;   // of its type
  std::atomic<pthread_t> ticking{};             // the thread that ticks it now; 0: none

  bool is_in_tick() const {
    const pthread_t thread = ticking.load(std::memory_order_relaxed);
    return thread != 0 && thread == pthread_self();
  }
  // The tree is ticked at once; from any thread. An older host cannot do that.
  void wake() const {
    constexpr std::size_t kSize = offsetof(lockstep_place, wake) + sizeof(lockstep_place::wake);
    if (node != nullptr && node->struct_size >= kSize) node->wake(caller);
  }
};

}  // namespace BT::lockstep_detail
