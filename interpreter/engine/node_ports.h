// The ports of the built-in nodes in one run (NodeType::reads_ports), and the entries whose names
// are known only while it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/blackboard.h"
#include "engine/named_entries.h"
#include "engine/tree.h"

namespace lockstep::host {

class NodePorts {
 public:
  // Both must outlive this, and the entries of `board` stay where they are.
  NodePorts(const Tree& tree, Blackboard& board)
      : tree_(tree),
        nodes_(tree.nodes.data()),
        ports_(tree.ports.data()),
        entries_(board.entries.data()),
        names_(board.names) {}

  // The words that scripts know as numbers; null if there are none.
  const ScriptEnums* words() const { return tree_.words.get(); }

  // Null: no {key}.
  Entry* entry(NodeIndex node, unsigned index) {
    const std::uint32_t slot = binding(node, index).slot;
    return slot == PortBinding::kUnbound ? nullptr : &entries_[slot];
  }
  // The same of a node whose parameters may be entries (Tree::bound).
  Entry* entry_of_bound(NodeIndex node, unsigned index) {
    const BoundNode& bound = tree_.bound[tree_.place_in_front(node, FrontCell::Bound)];
    const std::uint32_t slot = tree_.ports[bound.first_port + index].slot;
    return slot == PortBinding::kUnbound ? nullptr : &entries_[slot];
  }
  // Null: it has no value.
  const Value* value(NodeIndex node, unsigned index) const;
  // The entry that a port names (Parameter::is_key), which may not be present. Null if this tree
  // has no such entry. Nothing if the name has no value: missing_name says so.
  std::optional<Entry*> named(NodeIndex node, unsigned index);
  std::string missing_name(NodeIndex node, unsigned index) const;

  // The entry that `key` means where the node is, in a tree with boards. own_at: null if it belongs
  // to an outer tree. Both allocate.
  Entry& at(NodeIndex node, std::string_view key) { return names_.at(tree_.board_of(node), key); }
  Entry* own_at(NodeIndex node, std::string_view key) {
    return names_.own(tree_.board_of(node), key);
  }
  NamedEntries& names() { return names_; }
  const NamedEntries& names() const { return names_; }

 private:
  const PortBinding& binding(NodeIndex node, unsigned index) const {
    return ports_[nodes_[node].params + index];
  }

  const Tree& tree_;
  const Node* const nodes_;  // of the tree
  const PortBinding* const ports_;
  Entry* const entries_;
  NamedEntries& names_;
};

}  // namespace lockstep::host
