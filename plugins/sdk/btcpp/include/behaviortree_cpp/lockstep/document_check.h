// Refuses what the library refuses in a document. lockstep itself takes more: its command line
// warns.
#pragma once

#include <functional>
#include <string>

#include "behaviortree_cpp/lockstep/xml.h"

namespace BT::lockstep_detail {

class DocumentCheck {
 public:
  // The type of the node that has this ID; UNDEFINED: there is none.
  using TypeOf = std::function<NodeType(const std::string& id)>;

  // `knows_all`: a node that has no type is an error.
  DocumentCheck(TypeOf type_of, bool knows_all)
      : type_of_(std::move(type_of)), knows_all_(knows_all) {}

  // Throws RuntimeError.
  void operator()(const XmlElement& root) const {
    if (root.name != "root") refuse(root, StrCat("the root is <", root.name, ">, not <root>"));
    std::size_t models = 0;
    std::size_t trees = 0;
    for (const XmlElement& it : root.children) {
      if (it.name == "BehaviorTree") {
        check_tree(root, it);
        ++trees;
      } else if (it.name == "TreeNodesModel") {
        if (++models > 1) refuse(it, "there is a second TreeNodesModel; put all into one");
        for (const XmlElement& model : it.children) check_model(model);
      }
    }
  }

 private:
  [[noreturn]] static void refuse(const XmlElement& at, const std::string& what) {
    throw RuntimeError("the XML of the tree, line ", std::to_string(at.line), ": ", what);
  }

  static void check_id(const XmlElement& at, const std::string& id, const char* what) {
    const char wrong = findForbiddenChar(id);
    if (wrong == '\0') return;
    refuse(at, StrCat("the ID of ", what, ", '", id, "', has ", character(wrong),
                      "; an ID has no blanks, and none of <>&\"'/\\:*?|."));
  }
  static std::string character(char c) {
    return c == ' ' ? "a blank"
           : static_cast<unsigned char>(c) < 0x20 || c == 0x7f
               ? "a control character"
               : StrCat("the character '", std::string(1, c), "'");
  }

  void check_tree(const XmlElement& root, const XmlElement& tree) const {
    const std::string id = tree.get("ID");
    if (id.empty() && root.children.size() > 1) {
      refuse(tree, "a BehaviorTree beside others needs the attribute ID");
    }
    if (id == "Root" || id == "root") refuse(tree, StrCat("no tree may have the ID '", id, "'"));
    check_id(tree, id, "a tree");
    if (!id.empty() && type_of_(id) != NodeType::UNDEFINED) {
      refuse(tree, StrCat("the ID of the tree, '", id, "', is that of a registered node"));
    }
    if (tree.children.size() != 1) {
      refuse(tree, StrCat("the tree '", id, "' must have exactly one child; it has ",
                          std::to_string(tree.children.size())));
    }
    check_node(tree.children.front());
  }

  void check_model(const XmlElement& model) const {
    if (model.name != "SubTree") return;
    if (model.get("ID").empty()) {
      refuse(model, "a <SubTree> of TreeNodesModel needs the attribute ID");
    }
    for (const XmlElement& port : model.children) {
      if (port.name != "input_port" && port.name != "output_port" && port.name != "inout_port") {
        continue;
      }
      const std::string name = port.get("name");
      const bool is_allowed = !name.empty() && (name[0] < '0' || name[0] > '9') &&
                              findForbiddenChar(name) == '\0' && !IsReservedAttribute(name);
      if (is_allowed) continue;
      refuse(port,
             StrCat("'", name, "' cannot be the name of a port of the SubTree '", model.get("ID"),
                    "': no digit first, no blanks, no reserved word, and "
                    "none of <>&\"'/\\:*?|."));
    }
  }

  void check_node(const XmlElement& node) const {
    const std::size_t children = node.children.size();
    const std::string& tag = node.name;
    if (tag == "Action" || tag == "Condition") {
      need_id(node);
      if (children != 0) refuse(node, StrCat("<", tag, "> has children; a leaf has none"));
    } else if (tag == "Decorator") {
      need_id(node);
      need_one_child(node);
    } else if (tag == "Control") {
      need_id(node);
      if (children == 0) refuse(node, "<Control> has no children; it needs one or more");
    } else if (tag == "SubTree") {
      check_subtree(node);
    } else {
      check_compact(node);
    }
    for (const XmlElement& child : node.children) check_node(child);
  }

  static void need_id(const XmlElement& node) {
    if (node.get("ID").empty()) refuse(node, StrCat("<", node.name, "> needs the attribute ID"));
  }
  static void need_one_child(const XmlElement& node) {
    if (node.children.size() == 1) return;
    refuse(node, StrCat("the decorator <", node.name, "> must have exactly one child; it has ",
                        std::to_string(node.children.size())));
  }

  void check_subtree(const XmlElement& node) const {
    need_id(node);
    const std::string id = node.get("ID");
    if (!node.children.empty()) refuse(node, StrCat("the SubTree '", id, "' has children"));
    check_id(node, id, "a SubTree");
    if (type_of_(id) != NodeType::UNDEFINED) {
      refuse(node, StrCat("the ID of the SubTree, '", id, "', is that of a registered node"));
    }
  }

  // <Node/>, its tag being the ID.
  void check_compact(const XmlElement& node) const {
    const NodeType type = type_of_(node.name);
    if (type == NodeType::UNDEFINED) {
      if (!knows_all_ || is_known_otherwise(node.name)) return;
      refuse(node,
             StrCat("no node '", node.name, "' is registered; register its class before the tree"));
    }
    if (type == NodeType::DECORATOR) need_one_child(node);
    if (type == NodeType::CONTROL && node.children.empty()) {
      refuse(node, StrCat("the control node <", node.name, "> has no children"));
    }
    if (node.name == "ReactiveSequence") check_reactive(node);
  }
  // A tag of version 3, or of lockstep alone.
  static bool is_known_otherwise(const std::string& tag) {
    for (const char* it :
         {"SequenceStar", "FallbackStar", "RetryUntilSuccesful", "SubTreePlus", "ParallelAbsolute",
          "ParallelRelative", "WaitUntil", "SyncProgress", "UseResources"}) {
      if (tag == it) return true;
    }
    return false;
  }
  static void check_reactive(const XmlElement& node) {
    std::size_t asynchronous = 0;
    for (const XmlElement& child : node.children) {
      for (const char* it : {"Action", "Condition", "Control", "Decorator"}) {
        if (child.name == it) {
          refuse(child, StrCat("below a ReactiveSequence write <", child.get("ID"), "/>, not <", it,
                               " ID=\"", child.get("ID"), "\"/>"));
        }
      }
      if (child.name == "AsyncSequence" && ++asynchronous > 1) {
        refuse(child, "a ReactiveSequence has more than one asynchronous child");
      }
    }
  }

  TypeOf type_of_;
  bool knows_all_;
};

}  // namespace BT::lockstep_detail
