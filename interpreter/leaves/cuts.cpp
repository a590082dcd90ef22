#include "leaves/cuts.h"

#include <algorithm>
#include <cmath>

#include "engine/nodes/barrier_list.h"

namespace lockstep::host {
namespace {

constexpr double kRounding = 1e-9;
// More are as good as unknown: a grid has fewer.
constexpr std::size_t kMostCuts = 1000;

void add(std::vector<double>& values, double value) {
  if (value <= kRounding || value > 1 + kRounding) return;
  value = std::min(value, 1.0);
  const auto at = std::ranges::lower_bound(values, value - kRounding);
  if (at == values.end() || *at > value + kRounding) values.insert(at, value);
}

class CutFinder {
 public:
  CutFinder(const Tree& tree, const BarriersOfEntries& entries,
            std::span<const Observed::Progress> compared)
      : tree_(tree), entries_(entries), compared_(compared), cuts_(tree.nodes.size()) {}

  std::vector<Cuts> find() {
    add_compared(0);
    for (NodeIndex node = 1; node < tree_.nodes[0].end; ++node) {
      take_down(tree_.labels[node].parent, node);
    }
    return std::move(cuts_);
  }

 private:
  // Nodes are in pre-order, so those of the parent are known.
  void take_down(NodeIndex parent, NodeIndex node) {
    const Cuts& above = cuts_[parent];
    Cuts& here = cuts_[node];
    here.deltas = above.deltas;
    here.is_unknown = above.is_unknown;
    pull(above, parent, node, here.values);
    const Synchronization way = synchronization(tree_.nodes[parent]);
    if (compares_progress(way) && !tree_.is_group(parent)) add_own(parent, here);
    if (const Member* member = member_of(parent)) add_own(member->group, here);
    add_compared(node);
    if (here.values.size() > kMostCuts) here.is_unknown = true;
    if (here.is_unknown) here.values.clear();
  }

  void pull(const Cuts& above, NodeIndex parent, NodeIndex node, std::vector<double>& values) {
    const NodeType& type = *tree_.labels[parent].type;
    const auto children = static_cast<double>(tree_.nodes[parent].children);
    const double place = place_of(parent, node);
    if (type.id == "TryCatch") {  // its last child is apart
      const bool is_last = place + 1 == children;
      for (const double cut : above.values) {
        add(values, is_last ? cut : (children - 1) * cut - place);
      }
      return;
    }
    if (type.category == NodeCategory::Control && type.goes_on_after == Status::Success) {
      for (const double cut : above.values) add(values, children * cut - place);
      return;
    }
    const double rounds = rounds_of(parent);
    if (rounds < 0 && !above.values.empty()) cuts_[node].is_unknown = true;
    for (const double cut : above.values) {
      for (double round = 0; round < std::max(rounds, 1.0); ++round) {
        add(values, std::max(rounds, 1.0) * cut - round);
        if (values.size() > kMostCuts) return;
      }
    }
  }

  // At a constant and behind it, a comparison may differ.
  void add_compared(NodeIndex node) {
    for (const Observed::Progress& it : compared_) {
      if (it.node == node) add_list(std::span(&it.constant, 1), true, cuts_[node]);
    }
  }

  double place_of(NodeIndex parent, NodeIndex node) const {
    double place = 0;
    for (NodeIndex at = parent + 1; at != node; at = tree_.nodes[at].end) ++place;
    return place;
  }

  // The rounds that a node counts in its progress; 1: it counts none; negative: not known.
  double rounds_of(NodeIndex node) const {
    const NodeType& type = *tree_.labels[node].type;
    if (type.id != "Repeat") return 1;
    if (is_bound(node)) return -1;
    const double times = static_cast<double>(tree_.cells[tree_.nodes[node].params].integer);
    return times > 0 ? times : 1;
  }

  bool is_bound(NodeIndex node) const {
    return std::ranges::find(tree_.bound, node, &BoundNode::node) != tree_.bound.end();
  }

  const Member* member_of(NodeIndex node) const {
    const auto it = std::ranges::find(tree_.members, node, &Member::node);
    if (it == tree_.members.end()) return nullptr;
    return compares_progress(synchronization(tree_.nodes[it->group])) ? &*it : nullptr;
  }

  void add_own(NodeIndex node, Cuts& cuts) {
    if (synchronization(tree_.nodes[node]) == Synchronization::Relative) {
      const auto own = delta(tree_, node);
      own ? cuts.deltas.push_back(*own) : void(cuts.is_unknown = true);
      return;
    }
    if (const auto list = barriers(tree_, node)) {
      const bool ticks = tree_.cells[tree_.nodes[node].params + absolute::kAtBarrier].integer ==
                         absolute::kTickAtBarrier;
      return add_list(*list, ticks, cuts);
    }
    const auto bound = std::ranges::find(tree_.bound, node, &BoundNode::node);
    const std::uint32_t slot = tree_.ports[bound->first_port + absolute::kBarriers].slot;
    const auto known = entries_.find(slot);
    if (known == entries_.end()) {
      cuts.is_unknown = true;
    } else {
      add_list(known->second, true, cuts);
    }
  }

  // A child that goes on at a barrier is at it or behind it, which is not the same.
  static void add_list(std::span<const double> list, bool ticks_at_barrier, Cuts& cuts) {
    for (const double barrier : list) add(cuts.values, barrier);
    if (!ticks_at_barrier) return;
    const std::vector<double> at = cuts.values;
    for (std::size_t i = 0; i < at.size(); ++i) {
      add(cuts.values, (at[i] + (i + 1 < at.size() ? at[i + 1] : 1.0)) / 2);
    }
  }

  const Tree& tree_;
  const BarriersOfEntries& entries_;
  const std::span<const Observed::Progress> compared_;
  std::vector<Cuts> cuts_;
};

}  // namespace

std::vector<Cuts> cuts_of(const Tree& tree, const BarriersOfEntries& entries,
                          std::span<const Observed::Progress> compared) {
  return CutFinder(tree, entries, compared).find();
}

}  // namespace lockstep::host
