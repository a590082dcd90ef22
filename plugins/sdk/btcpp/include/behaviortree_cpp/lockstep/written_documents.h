// Documents that are written from manifests and trees. Included by xml_parsing.h.
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "behaviortree_cpp/lockstep/outline.h"
#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

inline XmlElement element_of(std::string name,
                             std::vector<std::pair<std::string, std::string>> attributes = {},
                             std::vector<XmlElement> children = {}) {
  XmlElement it;
  it.name = std::move(name);
  it.attributes = std::move(attributes);
  it.children = std::move(children);
  return it;
}

inline XmlElement written_root() {
  return element_of("root", {{"BTCPP_format", "4"}});
}

inline XmlElement written_port(const std::string& name, const PortInfo& port) {
  constexpr const char* kTags[] = {"input_port", "output_port", "inout_port"};
  XmlElement it = element_of(kTags[static_cast<int>(port.direction())],
                             {{"name", name}, {"type", port.typeName()}});
  if (!port.defaultValueString().empty()) it.set("default", port.defaultValueString());
  it.text = port.description();
  return it;
}

inline XmlElement written_model(const TreeNodeManifest& manifest) {
  XmlElement it = element_of(toStr(manifest.type), {{"ID", manifest.registration_ID}});
  const std::map<std::string, PortInfo> ports(manifest.ports.begin(), manifest.ports.end());
  for (const auto& [name, port] : ports) it.children.push_back(written_port(name, port));
  if (manifest.metadata.empty()) return it;
  XmlElement fields = element_of("MetadataFields");
  for (const auto& [key, value] : manifest.metadata) {
    fields.children.push_back(element_of("Metadata", {{key, value}}));
  }
  it.children.push_back(std::move(fields));
  return it;
}

// By ID, without those that are left out. SubTree is no model of a node.
inline XmlElement written_models(const std::unordered_map<std::string, TreeNodeManifest>& manifests,
                                 const std::set<std::string>& left_out) {
  XmlElement models = element_of("TreeNodesModel");
  for (const auto& [id, it] : std::map(manifests.begin(), manifests.end())) {
    if (left_out.count(id) == 0 && it.type != NodeType::SUBTREE) {
      models.children.push_back(written_model(it));
    }
  }
  return models;
}

// ---- A schema

inline XmlElement schema_attribute(const std::string& name, bool is_required = false) {
  XmlElement it = element_of("xs:attribute", {{"name", name}, {"type", "xs:string"}});
  if (is_required) it.set("use", "required");
  return it;
}

// Any nodes, so many.
inline XmlElement schema_nodes(const char* least, const char* most) {
  return element_of("xs:group", {{"ref", "node"}, {"minOccurs", least}, {"maxOccurs", most}});
}

inline XmlElement schema_type(std::vector<XmlElement> parts) {
  return element_of("xs:complexType", {}, std::move(parts));
}

inline XmlElement schema_node(const std::string& tag, NodeType type, const PortsList& ports,
                              bool is_explicit) {
  std::vector<XmlElement> parts;
  if (type == NodeType::CONTROL) {
    parts.push_back(element_of("xs:sequence", {}, {schema_nodes("1", "unbounded")}));
  } else if (type == NodeType::DECORATOR) {
    parts.push_back(element_of("xs:sequence", {}, {schema_nodes("1", "1")}));
  }
  if (is_explicit) parts.push_back(schema_attribute("ID", true));
  for (const auto& [name, port] : std::map(ports.begin(), ports.end())) {
    parts.push_back(schema_attribute(name));
  }
  parts.push_back(element_of("xs:attributeGroup", {{"ref", "common"}}));
  // A SubTree and the explicit form take ports of any name, and all take "_" attributes.
  parts.push_back(element_of("xs:anyAttribute", {{"processContents", "skip"}}));
  return element_of("xs:element", {{"name", tag}}, {schema_type(std::move(parts))});
}

inline XmlElement written_schema(
    const std::unordered_map<std::string, TreeNodeManifest>& manifests) {
  XmlElement choice = element_of("xs:choice");
  XmlElement schema = element_of("xs:schema", {{"xmlns:xs", "http://www.w3.org/2001/XMLSchema"},
                                               {"elementFormDefault", "qualified"}});
  std::map<std::string, XmlElement> nodes;
  for (const NodeType type : {NodeType::ACTION, NodeType::CONDITION, NodeType::CONTROL,
                              NodeType::DECORATOR, NodeType::SUBTREE}) {
    nodes[toStr(type)] = schema_node(toStr(type), type, {}, true);
  }
  for (const auto& [id, it] : manifests) {
    if (it.type != NodeType::SUBTREE) nodes[id] = schema_node(id, it.type, it.ports, false);
  }
  for (auto& [id, it] : nodes) {
    choice.children.push_back(element_of("xs:element", {{"ref", id}}));
  }
  const auto anything = [] {
    return element_of("xs:sequence", {},
                      {element_of("xs:any", {{"minOccurs", "0"},
                                             {"maxOccurs", "unbounded"},
                                             {"processContents", "skip"}})});
  };
  const auto any_attribute = [] {
    return element_of("xs:anyAttribute", {{"processContents", "skip"}});
  };
  XmlElement common = element_of("xs:attributeGroup", {{"name", "common"}});
  common.children.push_back(schema_attribute("name"));
  for (const auto& it : PreCondNames) common.children.push_back(schema_attribute(it));
  for (const auto& it : PostCondNames) common.children.push_back(schema_attribute(it));
  schema.children = {std::move(common),
                     element_of("xs:group", {{"name", "node"}}, {std::move(choice)})};
  for (auto& [id, it] : nodes) schema.children.push_back(std::move(it));
  XmlElement tree =
      element_of("xs:element", {{"name", "BehaviorTree"}},
                 {schema_type({element_of("xs:sequence", {}, {schema_nodes("1", "1")}),
                               schema_attribute("ID"), any_attribute()})});
  XmlElement include =
      element_of("xs:element", {{"name", "include"}},
                 {schema_type({schema_attribute("path", true), schema_attribute("ros_pkg")})});
  XmlElement models =
      element_of("xs:element", {{"name", "TreeNodesModel"}}, {schema_type({anything()})});
  XmlElement parts = element_of("xs:choice", {{"minOccurs", "0"}, {"maxOccurs", "unbounded"}},
                                {std::move(include), std::move(tree), std::move(models)});
  schema.children.push_back(
      element_of("xs:element", {{"name", "root"}},
                 {schema_type({std::move(parts), schema_attribute("BTCPP_format"),
                               schema_attribute("main_tree_to_execute"), any_attribute()})}));
  return schema;
}

// ---- A tree

// The nodes of an outline in its order, and so each element at its place.
inline void number_nodes(const Outline& outline, XmlElement& element, std::size_t& next) {
  const OutlineNode& node = outline.nodes[next++];
  element.set("_uid", std::to_string(node.uid));
  if (node.id == "SubTree") element.set("_fullpath", node.path);
  if (!node.has_children) return;
  for (XmlElement& it : element.children) number_nodes(outline, it, next);
}

// The main tree first, then each other tree: once, or with metadata each of its places.
inline void add_trees(const Outline& outline, bool add_metadata, XmlElement& root) {
  root.set("main_tree_to_execute", outline.subtrees.front().tree_id);
  std::set<std::string> written;
  for (std::size_t i = 0; i < outline.subtrees.size(); ++i) {
    const OutlineSubtree& subtree = outline.subtrees[i];
    if (!written.insert(add_metadata ? subtree.path : subtree.tree_id).second) continue;
    XmlElement tree = outline.set->trees.at(subtree.tree_id);
    if (add_metadata) {
      tree.set("_fullpath", subtree.path);
      // The nodes of a SubTree are among those of the one that it is in.
      std::vector<const OutlineNode*> inside;
      for (const OutlineNode& node : outline.nodes) {
        if (node.subtree == i) inside.push_back(&node);
      }
      Outline part;
      for (const OutlineNode* const it : inside) part.nodes.push_back(*it);
      std::size_t next = 0;
      number_nodes(part, tree.children.front(), next);
    }
    root.children.push_back(std::move(tree));
  }
}

}  // namespace BT::lockstep_detail
