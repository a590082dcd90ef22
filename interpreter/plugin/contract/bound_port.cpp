#include "plugin/contract/bound_port.h"

#include <cmath>
#include <utility>

#include "core/parameter_value.h"
#include "plugin/contract/host.h"

namespace lockstep::host {
namespace {

const Value kNothing;

BoundPort bound(const Tree& tree, const PortBinding& binding, const Parameter& parameter,
                Blackboard& blackboard) {
  BoundPort port{.parameter = &parameter,
                 .type = parameter.type,
                 .is_generic = parameter.is_generic,
                 .has_limits = has_limits(parameter)};
  const Value* const constant =
      binding.constant != PortBinding::kUnbound ? &tree.constants[binding.constant] : nullptr;
  if (binding.slot == PortBinding::kUnbound) {
    port.read = constant;
    port.is_checked = constant != nullptr && port.has_limits && !refuse_value(parameter, *constant);
    return port;
  }
  Entry& entry = blackboard.entries[binding.slot];
  port.read = &entry.value;
  port.is_strict = tree.slots[binding.slot].typing == Typing::Strict;
  if (parameter.direction != Direction::Input) port.write = &entry;
  port.fallback = constant;
  port.entry = tree.slots[binding.slot].name;
  return port;
}

}  // namespace

bool has_limits(const Parameter& port) {
  return std::isfinite(port.range.min) || std::isfinite(port.range.max) || !port.choices.empty();
}

const Value* BoundPort::ordinary() const {
  return read != nullptr && !must_be_checked() ? read : &kNothing;
}

PortMemory& BoundPort::remembered() {
  if (memory == nullptr) memory = std::make_unique<PortMemory>();
  return *memory;
}

void PortTable::reserve(std::size_t ports) {
  ports_.reserve(ports);
  ordinary_.reserve(ports);
}

void PortTable::add(BoundPort&& port) {
  const bool is_hidden = hides_entries_ && !port.entry.empty();
  ordinary_.push_back(is_hidden ? &kNothing : port.ordinary());
  ports_.push_back(std::move(port));
}

void PortTable::give_to(lockstep_caller& caller, std::size_t first) {
  caller.ports = {ports_.data() + first, ports_.size() - first};
  caller.ordinary = ordinary_.data() + first;
}

void bind_ports(const Tree& tree, const LeafNode& leaf, Blackboard& blackboard, PortTable& ports) {
  for (std::size_t index = 0; index < leaf.type->parameters.size(); ++index) {
    ports.add(
        bound(tree, tree.ports[leaf.first_port + index], leaf.type->parameters[index], blackboard));
  }
}

}  // namespace lockstep::host
