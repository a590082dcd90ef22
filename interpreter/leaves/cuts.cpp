#include "leaves/cuts.h"

#include <algorithm>
#include <cmath>

#include "base/core/progress.h"
#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// More are as good as unknown: a grid has fewer.
constexpr std::size_t kMostCuts = 1000;

void add(std::vector<double>& values, double value) {
  const auto at = std::ranges::lower_bound(values, value - kProgressEpsilon);
  if (at == values.end() || *at > value + kProgressEpsilon) values.insert(at, value);
}

void add_at(Cuts& cuts, double value) {
  if (value > kProgressEpsilon && value <= 1 + kProgressEpsilon) add(cuts.at, std::min(value, 1.0));
}

void add_behind(Cuts& cuts, double value) {
  if (value >= -kProgressEpsilon && value < 1 - kProgressEpsilon)
    add(cuts.behind, std::max(value, 0.0));
}

class CutFinder {
 public:
  CutFinder(const Tree& tree, const BarriersOfEntries& entries,
            std::span<const Observed::Progress> compared)
      : tree_(tree),
        entries_(entries),
        compared_(compared),
        cuts_(tree.nodes.size()),
        places_(tree.nodes.size()) {}

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
    pull(above, parent, here);
    const Synchronization way = synchronization(tree_.nodes[parent]);
    if (compares_progress(way) && !tree_.is_group(parent)) add_own(parent, here);
    if (const Member* member = barrier_member(tree_, parent)) add_own(member->group, here);
    add_compared(node);
    if (here.at.size() + here.behind.size() > kMostCuts) here.is_unknown = true;
    if (!here.is_unknown) return;
    here.at.clear();
    here.behind.clear();
  }

  void pull(const Cuts& above, NodeIndex parent, Cuts& here) {
    const auto children = static_cast<double>(tree_.nodes[parent].children);
    const double place = places_[parent]++;
    switch (tree_.labels[parent].type->progress_share) {
      case ProgressShare::EachChild:
        return add_part(above, children, place, here);
      case ProgressShare::EachButLast:
        if (place + 1 < children) return add_part(above, children - 1, place, here);
        break;
      case ProgressShare::EachRound:
        return add_rounds(above, parent, here);
      case ProgressShare::NotByPlace:
        break;
    }
    add_part(above, 1, 0, here);
  }

  static void add_part(const Cuts& above, double parts, double part, Cuts& here) {
    for (const double cut : above.at) add_at(here, parts * cut - part);
    for (const double cut : above.behind) add_behind(here, parts * cut - part);
  }

  // The end of a round is the beginning of the next one.
  void add_rounds(const Cuts& above, NodeIndex repeat, Cuts& here) {
    const bool has_cuts = !above.at.empty() || !above.behind.empty();
    if (is_bound(repeat) && has_cuts) here.is_unknown = true;
    const double rounds = is_bound(repeat) ? 1 : rounds_of(repeat);
    for (const double cut : above.at) {
      const double done = rounds * cut;
      add_at(here, done - (std::ceil(done - kProgressEpsilon) - 1));
    }
    for (const double cut : above.behind) {
      const double done = rounds * cut;
      add_behind(here, done - std::floor(done + kProgressEpsilon));
    }
  }

  void add_compared(NodeIndex node) {
    for (const Observed::Progress& it : compared_) {
      if (it.node == node) add_list(std::span(&it.constant, 1), true, cuts_[node]);
    }
  }

  double rounds_of(NodeIndex repeat) const {
    return std::max(1.0, static_cast<double>(tree_.cells[tree_.nodes[repeat].params].integer));
  }

  bool is_bound(NodeIndex node) const {
    return std::ranges::find(tree_.bound, node, &BoundNode::node) != tree_.bound.end();
  }

  void add_own(NodeIndex node, Cuts& cuts) {
    if (synchronization(tree_.nodes[node]) == Synchronization::Relative) {
      const auto own = delta(tree_, node);
      own ? cuts.deltas.push_back(*own) : void(cuts.is_unknown = true);
      return;
    }
    if (const auto list = barriers(tree_, node)) {
      return add_list(*list, ticks_at_barrier(tree_, node), cuts);
    }
    const auto known = entries_.find(entry_of_barriers(tree_, node));
    if (known == entries_.end()) {
      cuts.is_unknown = true;
    } else {
      add_list(known->second, true, cuts);
    }
  }

  // A child that goes on at a barrier is at it or behind it, which is not the same.
  static void add_list(std::span<const double> list, bool ticks_at_barrier, Cuts& cuts) {
    for (const double barrier : list) {
      add_at(cuts, barrier);
      if (ticks_at_barrier) add_behind(cuts, barrier);
    }
  }

  const Tree& tree_;
  const BarriersOfEntries& entries_;
  const std::span<const Observed::Progress> compared_;
  std::vector<Cuts> cuts_;
  std::vector<std::uint32_t> places_;  // of the next child of each node
};

}  // namespace

// Between a cut and the next one is what is behind the first and not at the second.
std::vector<double> Cuts::levels() const {
  std::vector<double> all = at;
  for (const double cut : behind) {
    const auto next = std::ranges::upper_bound(at, cut + kProgressEpsilon);
    add(all, (cut + (next == at.end() ? 1.0 : *next)) / 2);
  }
  return all;
}

std::vector<Cuts> cuts_of(const Tree& tree, const BarriersOfEntries& entries,
                          std::span<const Observed::Progress> compared) {
  return CutFinder(tree, entries, compared).find();
}

}  // namespace lockstep::host
