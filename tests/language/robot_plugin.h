// The plugin 'robot' of docs/language.md, linked into the tests: leaves with ports of every type
// that write down what they are told.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "lockstep/leaf.h"

namespace lockstep::host::test {

// What the leaves have said on this thread.
inline thread_local std::vector<std::string> said;

// Objects that its leaves made and nobody has destroyed yet.
inline std::atomic<int> objects_alive = 0;

const lockstep_plugin& robot_plugin();

// The plugin that ships, compiled into the test.
const lockstep_plugin& motion_plugin();

}  // namespace lockstep::host::test
