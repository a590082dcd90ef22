// Threads that are lockstep's own. They take no signals: those are for the tick thread, whose sleep
// they must end. A crash in one is not taken for a plugin's, and an exception that nobody expected
// in one ends the run, not the process.
#pragma once

#include <functional>
#include <span>
#include <thread>

namespace lockstep {

// Makes the calling thread one of ours, until it ends, with a stack on which the report of a stack
// overflow can be written.
void adopt_thread();
// Async-signal-safe.
bool is_own_thread();

// Starts one. It still takes the signals of a crash, and those of `taken`.
std::thread own_thread(std::function<void()> body, std::span<const int> taken = {});

// Throws what has ended one of these threads. One atomic load when nothing has.
void rethrow_thread_failure();

}  // namespace lockstep
