// A node's view of the program's tree that it is in.
#pragma once

#include <cstddef>
#include <functional>

namespace BT {
class TreeNode;
}

namespace BT::lockstep_detail {

class NodeTree {
 public:
  // Somebody wants to know what happens to its nodes, from now on.
  virtual void begin_watch() = 0;
  // Whether a result that a node has had is over, since its parent has completed.
  virtual bool is_over(const TreeNode& node) const = 0;
  // Halts it with all of the tree, unless the tree does that itself now. False: it does.
  virtual bool halt(const TreeNode& node) = 0;
  // A node and all below it, in the order of the tree.
  using Visitor = std::function<void(TreeNode* node, std::size_t depth)>;
  virtual void visit(const TreeNode& first, const Visitor& visitor) const = 0;

 protected:
  ~NodeTree() = default;
};

}  // namespace BT::lockstep_detail
