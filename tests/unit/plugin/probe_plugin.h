// A plugin that is linked into the test: a leaf with every function and one with as few as allowed,
// each of which does what the test wants it to do.
#pragma once

#include <deque>
#include <functional>
#include <string>

#include "base/system/call_mark.h"
#include "engine/tree.h"
#include "lockstep/leaf.h"
#include "run/loading/plugin_set.h"

namespace lockstep::host::test {

// Called in every function of the plugin, with its leaf (or run context). On this thread.
inline thread_local std::function<void(PluginFunction function, void* self)> on_probe_call;

class ProbeTree {
 public:
  // The first leaf is the root, so the others are not ticked.
  explicit ProbeTree(std::uint32_t full_leaves, std::uint32_t bare_leaves = 0);

  // The root node as XML, over leaves Full and Bare.
  explicit ProbeTree(const std::string& root);

  const Tree& tree() const { return tree_; }

 private:
  void add_leaf(const NodeType& type);

  PluginSet plugins_;
  std::deque<std::string> names_;
  Tree tree_;
};

}  // namespace lockstep::host::test
