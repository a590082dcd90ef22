// Finds the nodes that may withhold ticks from a node: a synchronized node from its children, a
// barrier from the children of its SyncProgress nodes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

class Withholding {
 public:
  static constexpr std::uint32_t kNobody = 0xffffffff;

  explicit Withholding(const Definition& definition) : definition_(definition) {
    for (const DefinitionGroup& group : definition.groups) {
      if (definition.is_pool(group) || !can_hold(group.node)) continue;
      for (const std::uint32_t member : group.members) barriers_.emplace(member, group.node);
    }
  }

  // The one that may hold the children of a node: itself, the barrier of a SyncProgress, or nobody.
  std::uint32_t of_children(std::uint32_t node) const {
    const DefinitionNode& it = definition_.nodes[node];
    if (it.type->category == NodeCategory::Control) {
      return compares_progress(it.type->synchronization) && can_hold(node) ? node : kNobody;
    }
    const auto barrier = barriers_.find(node);
    return barrier == barriers_.end() ? kNobody : barrier->second;
  }

  bool is_barrier(std::uint32_t holder) const {
    return holder != kNobody && holder >= definition_.nodes.front().end;
  }

  // Whether a synchronized node or barrier may hold a node whose progress runs from `begin` to
  // `end`, as long as another one is at `behind`. Limits from an entry may be anywhere.
  bool can_hold(std::uint32_t holder, double begin = 0, double end = 1, double behind = 0) const {
    constexpr double kTolerance = 1e-9;
    const DefinitionNode& it = definition_.nodes[holder];
    if (definition_.synchronization(it) == Synchronization::Relative) {
      const Value* delta = definition_.constant(it, "delta");
      return delta == nullptr || end > behind + std::get<double>(*delta) + kTolerance;
    }
    const Value* barriers = definition_.constant(it, "barriers");
    if (barriers == nullptr) return true;
    const double least = std::max(begin - kTolerance, behind + kTolerance);
    const auto& list = std::get<std::vector<double>>(*barriers);
    const auto next = std::ranges::lower_bound(list, least);
    return next != list.end() && *next < end - kTolerance;
  }

 private:
  const Definition& definition_;
  std::unordered_map<std::uint32_t, std::uint32_t> barriers_;  // of each SyncProgress
};

}  // namespace lockstep::host
