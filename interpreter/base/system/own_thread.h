// Threads that lockstep starts. They block signals, because a signal must end the sleep of the tick
// thread. A crash in one is not attributed to a plugin. An unexpected exception in one ends the
// run, not the process.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <thread>

#include "base/system/processors.h"

namespace lockstep::host {

// Marks the calling thread as one of lockstep's until it ends, and gives it a stack for reporting a
// stack overflow, to its last destructor.
void adopt_thread();
// Async-signal-safe.
bool is_own_thread();

// Starts a thread. It still receives the signals of a crash, and those in `taken`.
std::thread own_thread(std::function<void()> body, std::span<const int> taken = {});

// Where threads run that are started from now on; nothing: where the one that starts them does.
void keep_own_threads_on(const std::optional<Processors>& processors);

// Rethrows the exception that ended one of these threads. If there is none, this is one atomic
// load.
void rethrow_thread_failure();

}  // namespace lockstep::host
