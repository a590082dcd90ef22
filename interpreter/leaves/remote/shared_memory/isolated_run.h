// The leaves of an isolated plugin in one run. Each call goes to the process of the run, with what
// the leaf may read, and comes back with what the leaf has set.
#pragma once

#include <memory>

#include "leaves/remote/remote_plugin.h"
#include "leaves/remote/shared_memory/isolated_plugin.h"

namespace lockstep::host {

// Calls create_run in the process. Null after a failure, which is the caller's error.
std::unique_ptr<RemoteRun> begin_isolated_run(IsolatedPlugin& plugin,
                                              std::unique_ptr<Session> session,
                                              const lockstep_caller& caller);

}  // namespace lockstep::host
