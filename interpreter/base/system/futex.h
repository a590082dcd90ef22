// Lets a thread sleep until a word changes; the thread that changes it wakes the sleepers. They may
// be in different processes that share the memory.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/core/clock.h"

namespace lockstep::host {

// Returns at once unless `word` is `expected`; else after futex_wake, after `longest`, or
// spuriously.
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t expected, Nanoseconds longest);

// A system call. Async-signal-safe; never waits.
void futex_wake(std::atomic<std::uint32_t>& word);

}  // namespace lockstep::host
