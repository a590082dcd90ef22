// A node's view of the program's tree that it is in.
#pragma once

#include <cstddef>
#include <functional>

namespace BT {
class TreeNode;
}

namespace BT::lockstep_detail {

// Functions in place of virtual ones: of a virtual function that one class has, an optimizing
// compiler guesses that class and calls its function by name. A plugin would then need the library
// of a program, which that function calls.
class NodeTree {
 public:
  using Visitor = std::function<void(TreeNode* node, std::size_t depth)>;

  // Somebody wants to know what happens to its nodes, from now on.
  void begin_watch() { functions_.begin_watch(*this); }
  // Whether a result that a node has had is over, since its parent has completed.
  bool is_over(const TreeNode& node) const { return functions_.is_over(*this, node); }
  // Halts it with all of the tree, unless the tree does that itself now. False: it does.
  bool halt(const TreeNode& node) { return functions_.halt(*this, node); }
  // A node and all below it, in the order of the tree.
  void visit(const TreeNode& first, const Visitor& visitor) const {
    functions_.visit(*this, first, visitor);
  }

 protected:
  struct Functions {
    void (*begin_watch)(NodeTree& tree);
    bool (*is_over)(const NodeTree& tree, const TreeNode& node);
    bool (*halt)(NodeTree& tree, const TreeNode& node);
    void (*visit)(const NodeTree& tree, const TreeNode& first, const Visitor& visitor);
  };
  explicit NodeTree(const Functions& functions) : functions_(functions) {}
  ~NodeTree() = default;

 private:
  const Functions functions_;
};

}  // namespace BT::lockstep_detail
