// Nodes of plugins in tree texts: a test program that links the source of a plugin makes its nodes
// known, and ScriptedRun creates them beside its scripted leaves.
#pragma once

#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "leaves/plugin/contract/host.h"

namespace lockstep::host::test {

// A static object of a test file. The plugin must not have a run context.
struct KnownPlugin {
  explicit KnownPlugin(const lockstep_plugin& plugin);
};

// Null for an id that no plugin has.
const NodeType* plugin_node_type(std::string_view id);

// The nodes of plugins in one run.
class PluginNodes {
 public:
  PluginNodes(const Tree& tree, Blackboard& board, std::vector<LeafSlot>& slots);
  ~PluginNodes();
  PluginNodes(const PluginNodes&) = delete;
  PluginNodes& operator=(const PluginNodes&) = delete;

  // As LeafSet has it.
  void set_node_context(NodeContext& context) { run_.node_context = &context; }

  // Every node is created again.
  void restart();
  LeafTime time;

 private:
  void create_all();
  void destroy_all();

  const Tree& tree_;
  std::vector<LeafSlot>& slots_;
  LeafLog log_;
  CallerRun run_;
  std::vector<std::string> paths_;
  std::deque<PortTable> ports_;
  std::vector<std::unique_ptr<lockstep_caller>> callers_;  // null for a scripted leaf
};

}  // namespace lockstep::host::test
