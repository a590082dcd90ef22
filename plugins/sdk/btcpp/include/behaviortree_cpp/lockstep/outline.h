// The nodes of a tree as its documents say them, SubTrees expanded, before lockstep loads it: their
// names, paths and attributes, and what substitution rules make of it.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/lockstep/documents.h"
#include "behaviortree_cpp/lockstep/substitution.h"
#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

struct OutlineNode {
  const XmlElement* element;  // as the document has it
  std::string id;             // the registered one
  std::string name, path;     // as the library makes them
  std::uint16_t uid = 0;
  std::size_t subtree = 0;  // of the list of those
  bool is_substituted = false;
  bool has_children = true;  // false: a rule has taken those of the document away
};

struct OutlineSubtree {
  std::string tree_id, path;  // "" for the main tree
};

// The ID of the leaf that stands for the TestNodes of rules; no document can name it.
inline constexpr const char* kTestNodeId = "lockstep_TestNode";

struct Outline {
  std::shared_ptr<const TreeSet> set;  // that the elements are in
  std::vector<OutlineNode> nodes;      // in pre-order
  std::vector<OutlineSubtree> subtrees;
  std::map<std::string, std::shared_ptr<TestNodeConfig>> tests;  // by the path of the node
  std::string text;  // with what the rules replace; "": they replace nothing
};

// The ID of a node, whether it is written as a tag or as the attribute ID.
inline std::string registered_id(const XmlElement& element) {
  for (const char* it : {"Action", "Condition", "Control", "Decorator"}) {
    if (element.name == it) return element.get("ID");
  }
  return element.name == "SubTreePlus" ? "SubTree" : element.name;
}

// Statuses in a script as the numbers that they are.
inline std::string statuses_as_numbers(const std::string& script) {
  const auto in_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '@' || c == '.';
  };
  std::string text;
  for (std::size_t i = 0; i < script.size();) {
    std::size_t end = i + 1;
    if (script[i] == '\'' || script[i] == '"') {
      end = std::min(script.find(script[i], end), script.size() - 1) + 1;
    } else if (in_name(script[i])) {
      while (end < script.size() && in_name(script[end])) ++end;
    }
    const std::string token = script.substr(i, end - i);
    const auto* const status = std::find(std::begin(kStatusNames), std::end(kStatusNames), token);
    text += status == std::end(kStatusNames) ? token : std::to_string(status - kStatusNames);
    i = end;
  }
  return text;
}

// Where the last statement of a script begins.
inline std::size_t last_statement(std::string& script) {
  while (!script.empty() && StringView("; \t\r\n").find(script.back()) != StringView::npos) {
    script.pop_back();
  }
  std::size_t begin = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < script.size(); ++i) {
    if (quote != '\0') {
      if (script[i] == quote) quote = '\0';
    } else if (script[i] == '\'' || script[i] == '"') {
      quote = script[i];
    } else if (script[i] == ';') {
      begin = i + 1;
    }
  }
  return begin;
}

class OutlineMaker {
 public:
  using Manifests = std::unordered_map<std::string, TreeNodeManifest>;

  OutlineMaker(TreeSet set, const SubstitutionRules& rules, const Manifests& manifests)
      : rules_(rules), manifests_(manifests) {
    outline_->set = std::make_shared<const TreeSet>(std::move(set));
  }

  // Null: the tree is missing, or one contains itself; lockstep says where. Throws RuntimeError
  // when two SubTrees have one path, or a rule names a node that is not there, and
  // std::runtime_error, as the library does, when a SubTree names no tree.
  std::shared_ptr<const Outline> make(const std::string& main_tree) {
    const auto main = outline_->set->trees.find(main_tree);
    if (main == outline_->set->trees.end()) return nullptr;
    outline_->subtrees.push_back({main_tree, ""});
    bool is_changed = false;
    XmlElement made = expand_tree(main->second, 0, is_changed);
    if (is_broken_) return nullptr;
    if (is_changed) {
      versions_.push_back(std::move(made));
      write();
    }
    return outline_;
  }

 private:
  static XmlElement without_children(const XmlElement& from) {
    return {from.name, from.attributes, {}, from.text, from.line};
  }

  XmlElement expand_tree(const XmlElement& tree, std::size_t subtree, bool& is_changed) {
    XmlElement made = without_children(tree);
    if (++depth_ > kDeepestXml) is_broken_ = true;
    if (!is_broken_ && tree.children.size() == 1) {
      made.children.push_back(expand(tree.children.front(), subtree, is_changed));
    }
    --depth_;
    return made;
  }

  XmlElement expand(const XmlElement& element, std::size_t subtree, bool& is_changed) {
    OutlineNode node;
    node.element = &element;
    node.id = registered_id(element);
    const bool is_subtree = node.id == "SubTree";
    const std::string* const given = element.find("name");
    node.name = given != nullptr && !given->empty() ? *given
                : is_subtree                        ? element.get("ID")
                                                    : node.id;
    node.uid = static_cast<std::uint16_t>(outline_->nodes.size() + 1);
    node.subtree = subtree;
    const std::string& outer = outline_->subtrees[subtree].path;
    node.path = outer.empty() ? node.name : outer + "/" + node.name;
    const std::string inner_path = node.path;  // of a SubTree that has a name
    if (node.name == (is_subtree ? element.get("ID") : node.id)) {
      node.path += "::" + std::to_string(node.uid);
    }
    const SubstitutionRule* const rule = rule_for(rules_, node.name, node.id, node.path);
    node.is_substituted = rule != nullptr;
    outline_->nodes.push_back(node);
    if (rule != nullptr) {
      is_changed = true;
      return substituted(node, *rule, subtree, is_changed);
    }
    XmlElement made = without_children(element);
    if (is_subtree) {
      expand_subtree(node, given == nullptr ? node.path : inner_path, made, is_changed);
    } else {
      expand_children(element, made, subtree, is_changed);
    }
    return made;
  }

  void expand_children(const XmlElement& from, XmlElement& made, std::size_t subtree,
                       bool& is_changed) {
    for (const XmlElement& child : from.children) {
      made.children.push_back(expand(child, subtree, is_changed));
    }
  }

  // `path`: what is in front of those of its nodes.
  void expand_subtree(const OutlineNode& node, const std::string& path, XmlElement& made,
                      bool& is_changed) {
    const std::string id = made.get("ID");
    for (const OutlineSubtree& it : outline_->subtrees) {
      if (it.path != path) continue;
      throw RuntimeError("Duplicate SubTree path '", path,
                         "': two SubTrees of one tree have this name; give each another one");
    }
    const auto tree = outline_->set->trees.find(id);
    if (tree == outline_->set->trees.end()) {
      throw std::runtime_error(StrCat("line ", std::to_string(made.line), ": no tree '", id,
                                      "' is registered, which a SubTree names"));
    }
    outline_->subtrees.push_back({id, path});
    bool is_inner_changed = false;
    XmlElement inner = expand_tree(tree->second, outline_->subtrees.size() - 1, is_inner_changed);
    if (!is_inner_changed) return;
    // A version of the tree for this place alone.
    const std::string version = id + "." + std::to_string(versions_.size() + 1);
    inner.set("ID", version);
    versions_.push_back(std::move(inner));
    version_of_.emplace_back(id, version);
    made.set("ID", version);
    if (made.find("name") == nullptr) made.set("name", node.name);
    is_changed = true;
  }

  XmlElement substituted(const OutlineNode& node, const SubstitutionRule& rule, std::size_t subtree,
                         bool& is_changed) {
    const XmlElement& before = *node.element;
    XmlElement made;
    made.line = before.line;
    outline_->nodes.back().has_children = false;
    if (const auto test = test_of(rule)) {
      made.name = kTestNodeId;
      copy_attributes(before, made, {});
      add_scripts(*test, node.uid, made);
      outline_->tests[node.path] = test;
    } else {
      made.name = std::get<std::string>(rule);
      const auto manifest = manifests_.find(made.name);
      if (manifest == manifests_.end()) {
        throw RuntimeError("a substitution rule puts '", made.name, "' in the place of '",
                           node.path, "', but no node of that ID is registered");
      }
      copy_attributes(before, made, manifest->second.ports);
      const NodeType type = manifest->second.type;
      if (type == NodeType::CONTROL || type == NodeType::DECORATOR) {
        outline_->nodes.back().has_children = true;
        expand_children(before, made, subtree, is_changed);
      }
    }
    made.set("name", node.name);
    return made;
  }
  // Those of all nodes, and those that are ports.
  static void copy_attributes(const XmlElement& before, XmlElement& made, const PortsList& ports) {
    for (const auto& [name, value] : before.attributes) {
      const bool is_for_all = IsReservedAttribute(name) && name != "ID" && name != "_autoremap";
      if (is_for_all || ports.count(name) != 0) made.attributes.emplace_back(name, value);
    }
  }

  // The scripts of a TestNode as those of any node: in front of what the node has.
  static void add_scripts(const TestNodeConfig& test, std::uint16_t uid, XmlElement& made) {
    const auto add = [&made](const char* name, const std::string& script) {
      if (script.empty()) return;
      const std::string old = made.get(name);
      made.set(name, old.empty() ? script : StrCat(script, "; ", old));
    };
    add("_onSuccess", test.post_script);
    add("_onSuccess", test.success_script);
    add("_onFailure", test.post_script);
    add("_onFailure", test.failure_script);
    if (test.return_status_script.empty()) return;
    const std::string entry = "lockstep_status_" + std::to_string(uid);
    std::string script = statuses_as_numbers(test.return_status_script);
    script.insert(last_statement(script), StrCat(entry, " := "));
    const std::string old = made.get("_while");
    made.set("_while", StrCat(script, "; ", old.empty() ? "true" : old));
    made.set(TestNode::kLockstepPort, "{" + entry + "}");
  }

  void write() {
    XmlElement root;
    root.name = "root";
    root.set("BTCPP_format", "4");
    root.children = outline_->set->others;
    for (XmlElement& it : root.children) add_models(it);
    const std::string main = versions_.back().get("ID");
    for (const auto& [id, tree] : outline_->set->trees) {
      if (id != main) root.children.push_back(tree);
    }
    for (XmlElement& it : versions_) root.children.push_back(std::move(it));
    outline_->text = write_xml(root);
  }
  // A version of a tree has the ports of the tree.
  void add_models(XmlElement& models) const {
    if (models.name != "TreeNodesModel") return;
    for (const auto& [id, version] : version_of_) {
      for (std::size_t i = 0; i < models.children.size(); ++i) {
        if (models.children[i].name != "SubTree" || models.children[i].get("ID") != id) continue;
        XmlElement copy = models.children[i];
        copy.set("ID", version);
        models.children.push_back(std::move(copy));
        break;
      }
    }
  }

  std::shared_ptr<Outline> outline_ = std::make_shared<Outline>();
  const SubstitutionRules& rules_;
  const Manifests& manifests_;
  std::vector<XmlElement> versions_;  // the main tree last
  std::vector<std::pair<std::string, std::string>> version_of_;
  bool is_broken_ = false;
  int depth_ = 0;
};

// Reads what the document gives a node: its ports, also by their defaults, and other
// attributes. A SubTree has a port for each of its attributes.
inline void read_attributes(const XmlElement& element, const std::string& id,
                            const TreeNodeManifest* manifest, NodeNumber& node) {
  node.is_read = true;
  node.id = id;
  const bool is_subtree = id == "SubTree";
  if (!is_subtree) node.manifest = manifest;
  static const PortsList kNone;
  const PortsList& ports = manifest == nullptr ? kNone : manifest->ports;
  for (const auto& [name, value] : element.attributes) {
    if (IsReservedAttribute(name)) continue;
    const auto port = ports.find(name);
    if (is_subtree && !StartWith(name, '_')) {
      node.input_ports[name] = value;
    } else if (port == ports.end()) {
      node.other_attributes[name] = value;
    } else {
      if (port->second.direction() != PortDirection::OUTPUT) node.input_ports[name] = value;
      if (port->second.direction() != PortDirection::INPUT) node.output_ports[name] = value;
    }
  }
  for (const auto& [name, port] : ports) {
    const std::string& given = port.defaultValueString();
    if (given.empty()) continue;
    if (port.direction() != PortDirection::OUTPUT) node.input_ports.emplace(name, given);
    if (port.direction() != PortDirection::INPUT) node.output_ports.emplace(name, given);
  }
}

// Throws LogicError when a constant is no value of its port.
inline void check_constants(const Outline& outline,
                            const std::unordered_map<std::string, TreeNodeManifest>& manifests,
                            const ScriptingEnumsRegistry& words) {
  for (const OutlineNode& node : outline.nodes) {
    const auto manifest = manifests.find(node.id);
    if (node.is_substituted || manifest == manifests.end()) continue;
    for (const auto& [name, text] : node.element->attributes) {
      const auto port = manifest->second.ports.find(name);
      if (port == manifest->second.ports.end() || IsReservedAttribute(name)) continue;
      if (TreeNode::isBlackboardPointer(text) || words.count(text) != 0) continue;
      try {
        static_cast<void>(port->second.parseString(text));
      } catch (const std::exception& error) {
        throw LogicError("line ", std::to_string(node.element->line), ": the port '", name,
                         "' of '", node.path, "' takes a ", port->second.typeName(), ", and '",
                         text, "' is none: ", error.what());
      }
    }
  }
}

}  // namespace BT::lockstep_detail
