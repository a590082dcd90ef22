#include "engine/writers.h"

#include <algorithm>
#include <utility>

#include "language/expression/expression.h"  // IWYU pragma: keep

namespace lockstep::host {
namespace {

class Writers {
 public:
  explicit Writers(const Tree& tree) : tree_(tree), of_slot_(tree.slots.size()) {}

  std::vector<std::vector<NodeIndex>> find() {
    for (const LeafNode& leaf : tree_.leaves) add_ports(leaf.node, *leaf.type, leaf.first_port);
    for (const BoundNode& bound : tree_.bound)
      add_ports(bound.node, bound.kind->type, bound.first_port);
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) add_built_in(node);
    for (const HookedNode& hooked : tree_.hooked) {
      for (const std::uint32_t script : hooked.scripts) add_script(hooked.node, script);
    }
    for (auto& nodes : of_slot_) {
      std::ranges::sort(nodes);
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    return std::move(of_slot_);
  }

 private:
  void add_ports(NodeIndex node, const NodeType& type, std::uint32_t first) {
    for (std::size_t port = 0; port < type.parameters.size(); ++port) {
      const std::uint32_t slot = tree_.ports[first + port].slot;
      if (type.parameters[port].writes() && slot != PortBinding::kUnbound)
        of_slot_[slot].push_back(node);
    }
  }

  void add_built_in(NodeIndex node) {
    const NodeType& type = *tree_.labels[node].type;
    if (type.mock != nullptr && !type.mock->outputs.empty()) {
      return add_ports(node, type, tree_.nodes[node].params);
    }
    if (!type.plugin.empty() || type.mock != nullptr) return;  // no cells
    if (type.reads_ports) return add_ports(node, type, tree_.nodes[node].params);
    for (std::size_t index = 0; index < type.parameters.size(); ++index) {
      if (!type.parameters[index].is_script) continue;
      const std::int64_t script = tree_.cells[tree_.nodes[node].params + index].integer;
      add_script(node, static_cast<std::uint32_t>(script));
    }
  }

  void add_script(NodeIndex node, std::uint32_t index) {
    if (index >= tree_.scripts.size()) return;  // none
    const Script& script = tree_.scripts[index];
    if (!script.code) return;
    const auto uses = script.code->uses();
    for (std::size_t name = 0; name < uses.size(); ++name) {
      const bool writes = uses[name].is_assigned || uses[name].is_made;
      if (writes && script.slots[name] < of_slot_.size())
        of_slot_[script.slots[name]].push_back(node);
    }
  }

  const Tree& tree_;
  std::vector<std::vector<NodeIndex>> of_slot_;
};

}  // namespace

std::vector<std::vector<NodeIndex>> writers(const Tree& tree) {
  return Writers(tree).find();
}

}  // namespace lockstep::host
