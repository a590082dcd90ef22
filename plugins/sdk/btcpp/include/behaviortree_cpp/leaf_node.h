// A node without children.
#pragma once

#include "behaviortree_cpp/tree_node.h"

namespace BT {

class LeafNode : public TreeNode {
 public:
  using TreeNode::TreeNode;
};

}  // namespace BT
