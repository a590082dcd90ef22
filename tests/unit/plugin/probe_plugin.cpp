#include "unit/plugin/probe_plugin.h"

#include <stdexcept>

#include "engine/nodes/kinds.h"
#include "support/compiled.h"
#include "support/leaf_node.h"
#include "support/plugin_tables.h"

namespace lockstep::host::test {
namespace {

template <PluginFunction kFunction>
void call(void* self) {
  if (on_probe_call) on_probe_call(kFunction, self);
}

lockstep_status tick(void* self) {
  call<PluginFunction::Tick>(self);
  return LOCKSTEP_RUNNING;
}
double progress(void* self) {
  call<PluginFunction::Progress>(self);
  return 0.25;
}

void* create(const lockstep_host*, const lockstep_caller*, void*) {
  const auto self = new char;
  call<PluginFunction::Create>(self);
  return self;
}
void destroy(void* self) {
  call<PluginFunction::Destroy>(self);
  delete static_cast<char*>(self);
}

void* create_run(const lockstep_host*, const lockstep_caller*) {
  call<PluginFunction::CreateRun>(nullptr);
  return nullptr;
}

constexpr lockstep_leaf_type kTypes[] = {[] {
                                           lockstep_leaf_type type =
                                               tables::leaf_type("Full", create, destroy, tick);
                                           type.start = call<PluginFunction::Start>;
                                           type.halt = call<PluginFunction::Halt>;
                                           type.pause = call<PluginFunction::Pause>;
                                           type.resume = call<PluginFunction::Resume>;
                                           type.progress = progress;
                                           return type;
                                         }(),
                                         tables::leaf_type("Bare", create, destroy, tick)};
constexpr auto kLeaves = tables::list_of(kTypes);

constexpr lockstep_plugin kPlugin = [] {
  lockstep_plugin plugin = tables::plugin("probe", kLeaves);
  plugin.create_run = create_run;
  plugin.destroy_run = call<PluginFunction::DestroyRun>;
  return plugin;
}();

}  // namespace

ProbeTree::ProbeTree(std::uint32_t full_leaves, std::uint32_t bare_leaves) {
  Diagnostics diagnostics;
  if (!plugins_.add(kPlugin, "probe", diagnostics)) throw std::logic_error("probe was refused");
  tree_.id = "Main";
  const std::vector<const NodeType*> types = plugins_.types();
  for (std::uint32_t leaf = 0; leaf < full_leaves; ++leaf) add_leaf(*types[0]);
  for (std::uint32_t leaf = 0; leaf < bare_leaves; ++leaf) add_leaf(*types[1]);
}

ProbeTree::ProbeTree(const std::string& root) {
  Diagnostics diagnostics;
  if (!plugins_.add(kPlugin, "probe", diagnostics)) throw std::logic_error("probe was refused");
  tree_ =
      compiled("<root lockstep=\"1\"><BehaviorTree ID=\"Main\">" + root + "</BehaviorTree></root>",
               plugins_);
}

void ProbeTree::add_leaf(const NodeType& type) {
  const auto node = static_cast<NodeIndex>(tree_.leaves.size());
  const std::string& name = names_.emplace_back("leaf" + std::to_string(node));
  tree_.leaves.push_back({node, &type, 0});
  tree_.labels.push_back({name, &type, 0});
  tree_.nodes.push_back(leaf_node(kPluginAction, node));
}

}  // namespace lockstep::host::test
