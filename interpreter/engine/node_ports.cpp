#include "engine/node_ports.h"

#include "base/blackboard/conversion.h"

namespace lockstep::host {

const Value* NodePorts::value(NodeIndex node, unsigned index) const {
  const PortBinding& it = binding(node, index);
  if (it.slot != PortBinding::kUnbound) {
    const Entry& entry = entries_[it.slot];
    if (entry.is_present && entry.has_value()) return &entry.value();
  }
  return it.constant != PortBinding::kUnbound ? &tree_.constants[it.constant] : nullptr;
}

std::optional<Entry*> NodePorts::named(NodeIndex node, unsigned index) {
  const PortBinding& it = binding(node, index);
  if (it.slot == PortBinding::kUnbound) return nullptr;
  Entry& entry = entries_[it.slot];
  if (it.constant != PortBinding::kUnbound) return &entry;  // its name is in the tree
  const auto name =
      entry.is_present ? convert_value(entry.value(), ValueType::String, nullptr) : std::nullopt;
  if (!name) return std::nullopt;
  const auto& key = std::get<std::string>(*name);
  const bool own_only = tree_.labels[node].type->parameters[index].own_only;
  return own_only ? own_at(node, key) : &at(node, key);
}

std::string NodePorts::missing_name(NodeIndex node, unsigned index) const {
  std::string message = "'";
  message.append(tree_.labels[node].type->parameters[index].name);
  message.append("' has no value: nothing has written the entry '{");
  return message.append(tree_.slots[binding(node, index).slot].name).append("}'");
}

}  // namespace lockstep::host
