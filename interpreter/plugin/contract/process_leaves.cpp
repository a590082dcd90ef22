#include "plugin/contract/process_leaves.h"

#include <utility>

namespace lockstep::host {

void ProcessLeaves::remove(const ProcessLeaf& leaf) {
  std::erase_if(all_, [&](const Entry& it) { return it.leaf == &leaf; });
}

void ProcessLeaves::look(Ticker& ticker) {
  for (const auto& [node, leaf] : all_) {
    if (!ticker.held(node) || ticker.leaf(node).failed || ticker.faulted()) continue;
    if (std::string what = leaf->trouble(); !what.empty()) ticker.set_fault(node, std::move(what));
  }
}

}  // namespace lockstep::host
