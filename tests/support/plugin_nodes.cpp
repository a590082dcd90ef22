#include "support/plugin_nodes.h"

#include <deque>
#include <stdexcept>

#include "leaves/plugin/contract/descriptor.h"

namespace lockstep::host::test {
namespace {

std::deque<Descriptors>& known() {
  static std::deque<Descriptors> plugins;
  return plugins;
}

}  // namespace

KnownPlugin::KnownPlugin(const lockstep_plugin& plugin) {
  if (auto refusal = read_descriptors(plugin, 0, known().emplace_back())) {
    throw std::logic_error(refusal->message);
  }
}

const NodeType* plugin_node_type(std::string_view id) {
  for (const Descriptors& plugin : known()) {
    for (const auto& leaf : plugin.leaves) {
      if (leaf->node_type.id == id) return &leaf->node_type;
    }
  }
  return nullptr;
}

PluginNodes::PluginNodes(const Tree& tree, Blackboard& board, std::vector<LeafSlot>& slots)
    : time{.period = std::chrono::milliseconds(100), .thread = this_thread_id()},
      tree_(tree),
      slots_(slots),
      run_{.log = &log_, .tree = &tree} {
  for (const LeafNode& node : tree.leaves) paths_.push_back(tree.path(node.node));
  for (std::size_t index = 0; index < slots_.size(); ++index) {
    const LeafNode& node = tree.leaves[index];
    callers_.emplace_back();
    if (node.type->origin == nullptr) continue;
    slots_[index].type = node.type->leaf;
    callers_.back() = std::make_unique<lockstep_caller>(time, slots_[index], run_);
    lockstep_caller& caller = *callers_.back();
    caller.who = paths_[index].c_str();
    caller.type = node.type;
    caller.random = RandomStream(0, index + 1);
    caller.first_child = node.first_child;
    caller.children = node.children;
    PortBinder(tree, board, ports_.emplace_back()).bind(node);
    ports_.back().give_to(caller);
  }
  create_all();
}

PluginNodes::~PluginNodes() {
  destroy_all();
}

void PluginNodes::restart() {
  destroy_all();
  create_all();
}

void PluginNodes::create_all() {
  for (std::size_t index = 0; index < slots_.size(); ++index) {
    LeafSlot& slot = slots_[index];
    if (callers_[index] == nullptr) continue;
    slot.self = slot.type->create(&host_table(), callers_[index].get(), nullptr);
    if (slot.error != nullptr) throw std::runtime_error(slot.error);
  }
}

void PluginNodes::destroy_all() {
  for (std::size_t index = 0; index < slots_.size(); ++index) {
    if (callers_[index] != nullptr) slots_[index].type->destroy(slots_[index].self);
  }
}

}  // namespace lockstep::host::test
