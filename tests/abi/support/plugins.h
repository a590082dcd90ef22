// The plugins of tests/abi/plugins: loaded by name, into this process or one of their own, and a
// tree of one of their leaves.
#pragma once

#include <string>
#include <vector>

#include "engine/tree.h"
#include "run/loading/plugin_set.h"
#include "support/leaf_node.h"
#include "support/paths.h"

namespace lockstep::host::test {

inline std::string plugin_path(const std::string& name) {
  return std::string(LOCKSTEP_ABI_PLUGINS) + "/" + name + ".so";
}

// A set whose plugins are isolated, or not; everything a test of the contract says holds for both.
inline void set_isolation(PluginSet& plugins, Isolation isolation,
                          Nanoseconds hang_limit = std::chrono::seconds(20)) {
  plugins.set_isolation({.leafhost = LOCKSTEP_BINARY_DIR "/lockstep-leafhost",
                         .hang_limit = hang_limit,
                         .all = isolation == Isolation::Isolated});
}

// "message | hint" of each diagnostic.
inline std::vector<std::string> texts(const Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  for (const Diagnostic& it : diagnostics.all()) texts.push_back(it.message + " | " + it.hint);
  return texts;
}

// What `PluginSet::load_file` says of the file.
inline std::vector<std::string> refusal(const std::string& path,
                                        Isolation isolation = Isolation::InProcess) {
  PluginSet plugins;
  set_isolation(plugins, isolation);
  Diagnostics diagnostics;
  const bool loaded = plugins.load_file(path, diagnostics);
  std::vector<std::string> result = texts(diagnostics);
  if (loaded) result.push_back("was loaded");
  if (!plugins.types().empty()) result.push_back("left something behind");
  return result;
}

// A tree that is one leaf, whose first port is a constant.
inline Tree tree_of(const NodeType& leaf, std::int64_t ticks) {
  Tree tree;
  const bool is_action = leaf.category == NodeCategory::Action;
  tree.nodes.push_back(leaf_node(is_action ? kPluginAction : kPluginCondition));
  tree.leaves = {LeafNode{0, &leaf, 0}};
  tree.ports = {PortBinding{PortBinding::kUnbound, 0}};
  tree.constants = {Value(ticks)};
  tree.id = "Test";
  tree.labels = {NodeLabel{"probe", &leaf, 0}};
  return tree;
}

}  // namespace lockstep::host::test
