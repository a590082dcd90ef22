// What trees are made of is the business of lockstep: `lockstep nodes --format btcpp` prints the
// TreeNodesModel of a plugin.
#pragma once

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

template <class Factory>
std::string writeTreeNodesModelXML(const Factory&, bool = false) {
  static_assert(sizeof(Factory) == 0,
                "lockstep has no writeTreeNodesModelXML: 'lockstep nodes --format btcpp --plugin "
                "nodes.so' prints the TreeNodesModel");
  return {};
}

template <class Tree>
std::string WriteTreeToXML(const Tree&, bool = false, bool = false) {
  static_assert(sizeof(Tree) == 0,
                "lockstep has no WriteTreeToXML: 'lockstep show tree.xml' prints a tree with its "
                "subtrees");
  return {};
}
}  // namespace BT
