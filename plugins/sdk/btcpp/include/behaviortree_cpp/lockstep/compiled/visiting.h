// The functions of visiting.h. Included by it.
#pragma once

#include "behaviortree_cpp/lockstep/visiting.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE void buildSerializedStatusSnapshot(const TreeNode* root,
                                                         SerializedTreeStatus& snapshot) {
  snapshot.clear();
  applyRecursiveVisitor(root, [&snapshot](const TreeNode* node) {
    snapshot.emplace_back(node->UID(), static_cast<std::uint8_t>(node->status()));
  });
}

LOCKSTEP_BTCPP_INLINE const char* LibraryVersionString() {
  return "4.10.0";
}

LOCKSTEP_BTCPP_INLINE int LibraryVersionNumber() {
  return 41000;
}

}  // namespace BT
