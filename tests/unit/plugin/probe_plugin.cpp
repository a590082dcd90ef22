#include "unit/plugin/probe_plugin.h"

#include <stdexcept>

#include "engine/nodes/kinds.h"

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

constexpr lockstep_leaf_type leaf_type(const char* id) {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = LOCKSTEP_ACTION;
  type.id = id;
  type.create = create;
  type.destroy = destroy;
  type.tick = tick;
  return type;
}

constexpr lockstep_leaf_type kBare = leaf_type("Bare");
constexpr lockstep_leaf_type kFull = [] {
  lockstep_leaf_type type = leaf_type("Full");
  type.start = call<PluginFunction::Start>;
  type.halt = call<PluginFunction::Halt>;
  type.pause = call<PluginFunction::Pause>;
  type.resume = call<PluginFunction::Resume>;
  type.progress = progress;
  return type;
}();
const lockstep_leaf_type* const kLeaves[] = {&kFull, &kBare};

constexpr lockstep_plugin kPlugin = [] {
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = "probe";
  plugin.leaf_type_count = 2;
  plugin.leaf_types = kLeaves;
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
  if (tree_.leaves.size() == 1)
    tree_.nodes.push_back({.kind = &kPluginAction,
                           .end = 1,
                           .children = 0,
                           .is_guard = 0,
                           .is_latched = 0,
                           .params = 0,
                           .state = 0});
}

void ProbeTree::add_leaf(const NodeType& type) {
  const auto node = static_cast<NodeIndex>(tree_.leaves.size());
  const std::string& name = names_.emplace_back("leaf" + std::to_string(node));
  tree_.leaves.push_back({node, &type, 0});
  tree_.labels.push_back({name, &type, 0});
}

}  // namespace lockstep::host::test
