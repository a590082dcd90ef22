// A plugin that is linked into the test: its leaves do nothing but show the test who they are, so
// that it can call the host as a leaf would.
#pragma once

#include <string>
#include <vector>

#include "engine/tree.h"
#include "lockstep/leaf.h"
#include "run/loading/plugin_set.h"

namespace lockstep::host::test {

// What the plugin has seen on this thread.
struct Lab {
  std::vector<std::string> events;
  const lockstep_host* host = nullptr;
  const lockstep_caller* run = nullptr;
  std::vector<const lockstep_caller*> leaves;
  std::size_t leaf_that_fails = SIZE_MAX;  // sets an error in its create
  const char* run_error = nullptr;         // for create_run
};
inline thread_local Lab lab;

enum LabPort : std::uint32_t { kFlag, kCount, kSpeed, kText, kList, kLimit, kResult };

// Leaves "Lab" with the ports of LabPort: a bool input, an int, double, string and list inout, a
// double input with default 0.5, a double output.
const lockstep_plugin& lab_plugin();

// `leaves` Lab leaves under a root. The inouts are bound to slots 0 to 3 (for all leaves the same),
// 'flag' to a constant true, 'limit' to the constant 0.5, 'result' to nothing.
Tree lab_tree(const NodeType& type, std::uint32_t leaves);

}  // namespace lockstep::host::test
