// The manifests of the nodes that every tree has.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "behaviortree_cpp/lockstep/node_ports.h"
#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

// The type of a port by its name; any type where it is none of those that the language has.
inline TypeInfo type_info_of(StringView name) {
  if (name == "bool") return TypeInfo::Create<bool>();
  if (name == "int") return TypeInfo::Create<int>();
  if (name == "double") return TypeInfo::Create<double>();
  if (name == "std::string") return TypeInfo::Create<std::string>();
  return {};
}

inline void add_builtin_manifests(std::unordered_map<std::string, TreeNodeManifest>& manifests) {
  for (const BuiltinNode& it : kBuiltinNodes) {
    TreeNodeManifest manifest;
    manifest.type = it.type;
    manifest.registration_ID = it.id;
    manifests.emplace(it.id, std::move(manifest));
  }
  for (const BuiltinPort& it : kBuiltinPorts) {
    PortInfo port(it.direction, type_info_of(it.type));
    port.setDescription(it.text);
    if (it.given != nullptr) port.setDefaultValue(std::string(it.given));
    manifests.at(it.node).ports.emplace(it.name, std::move(port));
  }
}

}  // namespace BT::lockstep_detail
