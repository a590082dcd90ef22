// The statuses of all nodes below one, and what the library calls its version.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "behaviortree_cpp/behavior_tree.h"

namespace BT {

// The number and the status of each node.
using SerializedTreeStatus = std::vector<std::pair<std::uint16_t, std::uint8_t>>;

inline void buildSerializedStatusSnapshot(const TreeNode* root, SerializedTreeStatus& snapshot) {
  snapshot.clear();
  applyRecursiveVisitor(root, [&snapshot](const TreeNode* node) {
    snapshot.emplace_back(node->UID(), static_cast<std::uint8_t>(node->status()));
  });
}

// The version of the library that these headers stand for.
inline const char* LibraryVersionString() {
  return "4.10.0";
}
inline int LibraryVersionNumber() {
  return 41000;
}

}  // namespace BT
