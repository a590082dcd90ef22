// The statuses of all nodes below one, and what the library calls its version.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "behaviortree_cpp/behavior_tree.h"

namespace BT {

// The number and the status of each node.
using SerializedTreeStatus = std::vector<std::pair<std::uint16_t, std::uint8_t>>;

void buildSerializedStatusSnapshot(const TreeNode* root, SerializedTreeStatus& snapshot);

// The version of the library that these headers stand for.
const char* LibraryVersionString();
int LibraryVersionNumber();

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/visiting.h"  // IWYU pragma: export
#endif
