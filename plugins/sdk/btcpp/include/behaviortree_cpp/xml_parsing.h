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

}  // namespace BT
