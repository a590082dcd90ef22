#include "show/view/tree_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace lockstep::host {
namespace {

// One past the last node below `node`: in pre-order, the next one that is not deeper.
NodeIndex end_of(const Shape& tree, NodeIndex node) {
  NodeIndex end = node + 1;
  while (end < tree.nodes.size() && tree.nodes[end].depth > tree.nodes[node].depth) ++end;
  return end;
}

// The order in which nodes get a row.
class Ranking {
 public:
  Ranking(const Shape& tree, const Snapshot& snapshot) : tree_(tree), snapshot_(snapshot) {
    from_active_.resize(tree.nodes.size());
    for (NodeIndex node = 0; node < tree.nodes.size(); ++node) place(node);
  }

 private:
  enum Group : std::uint8_t { RunsInStep, Runs, Waits, LeadsToIt, WaitsBelow, Rest };

 public:
  // The least comes first.
  std::tuple<Group, std::size_t, std::size_t, NodeIndex> key(NodeIndex node) const {
    const Group in = group(node);
    if (in == LeadsToIt) return {in, SIZE_MAX - tree_.nodes[node].depth, 0, node};
    if (in != Rest) return {in, 0, 0, node};
    const Distance& from = from_active_[node];
    // Once the run has ended: why it failed, before all else.
    const bool is_why = !is_active(0) && activity(node) == Activity::Failure;
    return {in, is_why ? 0 : from.levels, from.siblings, node};
  }

 private:
  // How far a node that is not active is from what is: siblings are apart, then levels below them.
  struct Distance {
    std::size_t levels = 0, siblings = 0;
  };

  Activity activity(NodeIndex node) const { return snapshot_.nodes[node].activity; }
  bool is_active(NodeIndex node) const { return status_of(activity(node)) == Status::Running; }

  // A parent comes before its children.
  void place(NodeIndex node) {
    const ShapeNode& it = tree_.nodes[node];
    if (is_active(node)) return place_children(it.children);
    for (const NodeIndex child : it.children) {
      from_active_[child] = from_active_[node];
      ++from_active_[child].levels;
    }
  }

  void place_children(const std::vector<NodeIndex>& children) {
    const auto sweep = [&](auto first, auto last) {
      std::size_t distance = children.size();
      for (; first != last; ++first) {
        distance = is_active(*first) ? 0 : distance + 1;
        std::size_t& least = from_active_[*first].siblings;
        least = std::min(least, distance);
      }
    };
    for (const NodeIndex child : children) from_active_[child].siblings = SIZE_MAX;
    sweep(children.begin(), children.end());
    sweep(children.rbegin(), children.rend());
  }

  bool is_in_step(NodeIndex node) const {
    const ShapeNode& it = tree_.nodes[node];
    return it.synchronization != Synchronization::None || it.keeper;
  }

  Group group(NodeIndex node) const {
    const ShapeNode& it = tree_.nodes[node];
    if (!is_active(node)) return Rest;
    if (activity(node) == Activity::Paused) {
      const bool below = it.parent && activity(*it.parent) == Activity::Paused;
      return below ? WaitsBelow : Waits;
    }
    if (is_in_step(node)) return RunsInStep;
    return it.children.empty() ? Runs : LeadsToIt;
  }

  const Shape& tree_;
  const Snapshot& snapshot_;
  std::vector<Distance> from_active_;
};

// The window of rows around the cursor.
void show_around(NodeIndex cursor, std::size_t room, Layout& layout) {
  const auto at = std::lower_bound(layout.rows.begin(), layout.rows.end(), cursor);
  const auto row = static_cast<std::size_t>(at - layout.rows.begin());
  layout.first = std::min(row - std::min(row, room / 2), layout.rows.size() - room);
  layout.rows.erase(layout.rows.begin(),
                    layout.rows.begin() + static_cast<std::ptrdiff_t>(layout.first));
  layout.rows.resize(room);
}

}  // namespace

void Tally::add(Activity activity) {
  ++(activity == Activity::Paused ? waiting_ : others_[index_of(status_of(activity))]);
}

std::size_t Tally::sum() const {
  return std::accumulate(others_.begin(), others_.end(), waiting_);
}

std::string Tally::text() const {
  std::string text;
  const auto add_part = [&text](std::size_t count, std::string_view what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  const auto add_status = [&](const StatusRow& row) {
    add_part(others_[index_of(row.status)], row.counted);
  };
  add_status(row_of(Status::Running));
  add_part(waiting_, "waiting");
  for (const StatusRow& row : kStatuses) {
    if (has_ended(row.status)) add_status(row);
  }
  add_status(row_of(Status::Idle));
  return text;
}

std::vector<NodeIndex> unfolded(const Shape& tree, const std::set<NodeIndex>& folded) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size();) {
    nodes.push_back(node);
    node = folded.count(node) != 0 ? end_of(tree, node) : node + 1;
  }
  return nodes;
}

Tally tally_below(const Shape& tree, const Snapshot& snapshot, NodeIndex node) {
  Tally tally;
  const NodeIndex end = end_of(tree, node);
  for (NodeIndex below = node + 1; below < end; ++below) {
    tally.add(snapshot.nodes[below].activity);
  }
  return tally;
}

Layout lay_out(const Shape& tree, const Snapshot& snapshot, const Browsing& browsing,
               std::size_t room) {
  Layout layout{.rows = unfolded(tree, browsing.folded)};
  layout.all = layout.rows.size();
  if (layout.all <= room) return layout;
  --room;
  if (browsing.cursor) {
    show_around(*browsing.cursor, room, layout);
    return layout;
  }
  const auto end = layout.rows.begin() + static_cast<std::ptrdiff_t>(room);
  const Ranking ranking(tree, snapshot);
  std::nth_element(layout.rows.begin(), end, layout.rows.end(),
                   [&](NodeIndex a, NodeIndex b) { return ranking.key(a) < ranking.key(b); });
  std::for_each(end, layout.rows.end(),
                [&](NodeIndex node) { layout.left_out.add(snapshot.nodes[node].activity); });
  layout.rows.erase(end, layout.rows.end());
  std::sort(layout.rows.begin(), layout.rows.end());
  return layout;
}

}  // namespace lockstep::host
