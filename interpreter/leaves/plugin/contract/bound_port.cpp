#include "leaves/plugin/contract/bound_port.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/core/parameter_value.h"
#include "leaves/plugin/contract/host.h"

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
  port.read = &entry.value();
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

BoundPort& PortTable::add(BoundPort&& port) {
  constexpr std::size_t kSmallest = 4, kLargest = 1024;
  if (own_.empty() || own_.back().size() == own_.back().capacity()) {
    own_.emplace_back().reserve(std::clamp(ports_.size(), kSmallest, kLargest));
  }
  BoundPort& own = own_.back().emplace_back(std::move(port));
  share(own);
  return own;
}

void PortTable::share(BoundPort& port) {
  const bool is_hidden = hides_entries_ && !port.entry.empty();
  ordinary_.push_back(is_hidden ? &kNothing : port.ordinary());
  ports_.push_back(&port);
}

void PortTable::give_to(lockstep_caller& caller, std::size_t first) {
  give_to(caller, first, ports_.size() - first);
}

void PortTable::give_to(lockstep_caller& caller, std::size_t first, std::size_t count) {
  caller.ports = {ports_.data() + first, count};
  caller.ordinary = ordinary_.data() + first;
}

void PortTable::shrink() {
  ports_.shrink_to_fit();
  ordinary_.shrink_to_fit();
}

bool PortBinder::has_same_constants(const LeafNode& node, const LeafNode& other) const {
  const auto bindings = [&](const LeafNode& of) {
    return std::span(tree_.ports).subspan(of.first_port, of.type->parameters.size());
  };
  constexpr std::uint32_t kUnbound = PortBinding::kUnbound;
  return node.type == other.type &&
         std::ranges::equal(bindings(node), bindings(other), [](auto& a, auto& b) {
           return a.constant == b.constant && a.slot == kUnbound && b.slot == kUnbound;
         });
}

std::size_t PortBinder::bind(const LeafNode& node) {
  const std::uintptr_t place = reinterpret_cast<std::uintptr_t>(node.type) / sizeof(NodeType);
  KnownLeaf& known = known_leaves_[place % known_leaves_.size()];
  if (known.leaf != nullptr && has_same_constants(node, *known.leaf)) return known.first;
  known = {&node, ports_.size()};
  for (std::size_t index = 0; index < node.type->parameters.size(); ++index) {
    bind(tree_.ports[node.first_port + index], node.type->parameters[index]);
  }
  return known.first;
}

void PortBinder::bind(const PortBinding& binding, const Parameter& parameter) {
  const auto make = [&]() -> BoundPort& {
    return ports_.add(bound(tree_, binding, parameter, blackboard_));
  };
  if (binding.slot != PortBinding::kUnbound) {
    make();
    return;
  }
  const std::uintptr_t of_type = reinterpret_cast<std::uintptr_t>(&parameter) / sizeof(Parameter);
  KnownPort& known = known_ports_[(of_type + binding.constant) % known_ports_.size()];
  const bool is_known = known.port != nullptr && known.constant == binding.constant &&
                        known.port->parameter == &parameter;
  if (is_known) {
    ports_.share(*known.port);
  } else {
    known = {binding.constant, &make()};
  }
}

}  // namespace lockstep::host
