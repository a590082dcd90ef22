// Control nodes and decorators that plugin_control_test.cpp ticks. They are in a file without the
// engine's headers, as those of plugins are.
#pragma once

#include <functional>

#include "lockstep/leaf.h"

namespace lockstep::host::test {

extern const lockstep_plugin& kControlNodes;
// Called by the node Watching with the name of its function.
extern std::function<void(const char*)> watching_seen;

}  // namespace lockstep::host::test
