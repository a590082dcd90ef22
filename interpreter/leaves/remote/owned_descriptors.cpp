#include "leaves/remote/owned_descriptors.h"

namespace lockstep::host {
namespace {

// Stands for a function of the other process, which LeafDescriber asks for.
const lockstep_leaf_type* describe_elsewhere(const lockstep_fixed* /*fixed*/,
                                             std::uint32_t /*count*/, lockstep_refusal* /*why*/) {
  return nullptr;
}

}  // namespace

lockstep_leaf_type& OwnedDescriptors::add_leaf() {
  lockstep_leaf_type& type = leaves_.emplace_back().type;
  types_.push_back(&type);
  plugin.leaf_types = types_.data();
  plugin.leaf_type_count = static_cast<std::uint32_t>(types_.size());
  return type;
}

lockstep_port& OwnedDescriptors::add_port() {
  Leaf& leaf = leaves_.back();
  lockstep_port& port = ports_.emplace_back();
  port.struct_size = sizeof port;
  leaf.ports.push_back(&port);
  leaf.type.ports = leaf.ports.data();
  leaf.type.port_count = static_cast<std::uint32_t>(leaf.ports.size());
  return port;
}

void OwnedDescriptors::add_behavior(std::string_view word, std::string_view value) {
  Leaf& leaf = leaves_.back();
  leaf.behavior.push_back({keep(word), keep(value)});
  leaf.type.behavior = leaf.behavior.data();
  leaf.type.behavior_count = static_cast<std::uint32_t>(leaf.behavior.size());
}

void OwnedDescriptors::set_more_ports(std::string_view patterns) {
  lockstep_leaf_type& type = leaves_.back().type;
  type.more_ports = keep(patterns);
  type.describe = describe_elsewhere;
}

}  // namespace lockstep::host
