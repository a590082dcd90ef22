#include "leaves/plugin/contract/process_leaves.h"

#include <utility>

namespace lockstep::host {

void ProcessLeaves::remove(const ProcessLeaf& leaf) {
  std::erase_if(all_, [&](const Entry& it) { return it.leaf == &leaf; });
}

void ProcessLeaves::look(NodeContext& context) {
  for (const auto& [node, leaf] : all_) {
    if (!context.held(node) || context.leaf(node).failed() || context.faulted()) continue;
    if (std::string what = leaf->trouble(); !what.empty()) context.set_fault(node, std::move(what));
  }
}

}  // namespace lockstep::host
