#include "verify/symmetry.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace lockstep::host {
namespace {

// Labels number what may move in 16 bits: leaves and the children that are held.
constexpr std::size_t kMostMoving = 30'000;

// All that such a kind keeps means the same at another place, but for the number of a child.
bool can_move(const NodeKind* kind) {
  return kind->if_moved != IfMoved::Differs ||
         (kind->state_size == 0 && kind->state_per_child == 0);
}

bool uses_entries(const Parameter& it) {
  return it.is_script || it.is_key || it.names_entry || it.is_generic;
}

class EqualChildrenFinder {
 public:
  EqualChildrenFinder(const Tree& tree, const LeafModels& models, const std::vector<bool>& watched)
      : tree_(tree),
        models_(models),
        is_told_apart_(tree.nodes.size()),
        is_set_(models.facts.size()) {
    for (const LeafModel& leaf : models.leaves) {
      for (const LeafModel::Set& set : leaf.sets) is_set_[set.fact] = true;
    }
    find_where_order_counts(watched);
  }

  // A node that nobody can tell from one that does the same.
  std::vector<bool> on_their_own() const {
    std::vector<bool> found = is_told_apart_;
    found.flip();
    return found;
  }

  // From the last parallel to the first: the ones inside of a child come before it.
  std::vector<EqualChildren> find() {
    std::vector<EqualChildren> found;
    for (NodeIndex node = tree_.nodes[0].end; node-- > 0;) {
      if (tree_.nodes[node].kind->has_any_order && !may_fault_[node]) add_classes(node, found);
    }
    return found;
  }

 private:
  void find_where_order_counts(const std::vector<bool>& watched) {
    may_fault_.resize(tree_.nodes.size());
    for (const BoundNode& it : tree_.bound) may_fault_[it.node] = true;
    for (const HookedNode& it : tree_.hooked) may_fault_[it.node] = true;
    for (const Member& it : tree_.members) is_told_apart_[it.node] = true;
    for (NodeIndex node = tree_.nodes[0].end; node-- > 0;) {
      look_at(node);
      if (watched[node] || may_fault_[node] || !can_move(tree_.nodes[node].kind)) {
        is_told_apart_[node] = true;
      }
      const NodeIndex parent = tree_.labels[node].parent;
      if (may_fault_[node]) may_fault_[parent] = true;
      if (is_told_apart_[node]) is_told_apart_[parent] = true;
    }
  }

  // The tick of a fault ends at the node that has it, so those behind it get none.
  void look_at(NodeIndex node) {
    const NodeKind& kind = *tree_.nodes[node].kind;
    const NodeType& type = *tree_.labels[node].type;
    if (type.leaf != nullptr) {
      const LeafModel& leaf = models_.leaves[tree_.nodes[node].params];
      if (leaf.results.fault) may_fault_[node] = true;
      const bool has_set_fact = leaf.fact != kNoFact && is_set_[leaf.fact];
      if (has_set_fact || !leaf.sets.empty() || !leaf.outputs.empty()) is_told_apart_[node] = true;
      return;
    }
    const bool reads = type.reads_ports || kind.reads_entries || kind.counts_writes;
    if (reads || std::ranges::any_of(type.parameters, uses_entries)) may_fault_[node] = true;
  }

  void add_classes(NodeIndex parent, std::vector<EqualChildren>& found) const {
    std::vector<std::vector<NodeIndex>> classes;
    for (NodeIndex child = parent + 1; child < tree_.nodes[parent].end;
         child = tree_.nodes[child].end) {
      if (is_told_apart_[child]) continue;
      const auto known = std::ranges::find_if(
          classes, [&](const auto& it) { return are_equal(it.front(), child); });
      known == classes.end() ? classes.push_back({child}) : known->push_back(child);
    }
    for (const auto& it : classes) {
      if (it.size() > 1) found.push_back(class_of(it));
    }
  }

  EqualChildren class_of(const std::vector<NodeIndex>& children) const {
    const EqualChildren::Place first = EqualChildren::place_of(tree_, children.front());
    const EqualChildren::Place last =
        EqualChildren::place_of(tree_, tree_.nodes[children.front()].end);
    EqualChildren found{.nodes = last.node - first.node,
                        .leaves = last.leaf - first.leaf,
                        .words = last.word - first.word,
                        .places = {}};
    for (const NodeIndex child : children)
      found.places.push_back(EqualChildren::place_of(tree_, child));
    return found;
  }

  bool are_equal(NodeIndex one, NodeIndex other) const {
    const NodeIndex size = tree_.nodes[one].end - one;
    if (tree_.nodes[other].end - other != size) return false;
    for (NodeIndex i = 0; i < size; ++i) {
      const Node& a = tree_.nodes[one + i];
      const Node& b = tree_.nodes[other + i];
      const bool is_alike = a.kind == b.kind && a.end - one == b.end - other &&
                            a.children == b.children && a.synchronizes == b.synchronizes &&
                            a.is_guard == b.is_guard && a.is_latched == b.is_latched &&
                            a.is_begun_once == b.is_begun_once;
      if (!is_alike || !have_equal_values(one + i, other + i)) return false;
    }
    return true;
  }

  bool have_equal_values(NodeIndex one, NodeIndex other) const {
    const NodeType& type = *tree_.labels[one].type;
    const std::uint32_t first = tree_.nodes[one].params, second = tree_.nodes[other].params;
    if (type.leaf != nullptr) {
      LeafModel model = models_.leaves[first];
      model.node = models_.leaves[second].node;
      return tree_.labels[other].type->leaf != nullptr && model == models_.leaves[second];
    }
    if (&type != tree_.labels[other].type) return false;  // also of stand-ins
    if (type.mock != nullptr) return true;
    for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
      const Cell& a = tree_.cells[first + i];
      const Cell& b = tree_.cells[second + i];
      if (type.parameters[i].type != ValueType::DoubleList) {
        if (a.integer != b.integer) return false;
      } else if (!std::ranges::equal(numbers(a), numbers(b))) {
        return false;
      }
    }
    return true;
  }

  std::span<const double> numbers(const Cell& cell) const {
    return std::span(tree_.numbers).subspan(cell.list.first, cell.list.count);
  }

  const Tree& tree_;
  const LeafModels& models_;
  // Each is true for a node if it is so with it or with a node below it.
  std::vector<bool> may_fault_, is_told_apart_;
  std::vector<bool> is_set_;  // of each fact: by a leaf
};

}  // namespace

EqualChildren::Place EqualChildren::place_of(const Tree& tree, NodeIndex node) {
  const auto leaf = std::ranges::lower_bound(tree.leaves, node, {}, &LeafNode::node);
  const std::size_t byte = node < tree.nodes.size() ? tree.nodes[node].state : tree.state_size;
  return {node, static_cast<std::uint32_t>(leaf - tree.leaves.begin()),
          static_cast<std::uint32_t>(byte / sizeof(std::uint64_t))};
}

Symmetry::Symmetry(const Tree& tree, const LeafModels& models, const std::vector<bool>& watched)
    : first_like_(tree.nodes.size()), moves_(tree.nodes.size()) {
  EqualChildrenFinder finder(tree, models, watched);
  classes_ = finder.find();
  on_its_own_ = finder.on_their_own();
  std::iota(first_like_.begin(), first_like_.end(), NodeIndex{0});
  std::size_t moving = 0;
  for (const EqualChildren& it : classes_) moving += it.places.size() * it.nodes;
  if (moving > kMostMoving) classes_.clear();
  for (const EqualChildren& it : classes_) {
    for (const EqualChildren::Place& place : it.places) {
      for (NodeIndex i = 0; i < it.nodes; ++i) {
        moves_[place.node + i] = true;
        first_like_[place.node + i] = first_like_[it.places.front().node + i];
      }
    }
  }
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (moves_[node] && tree.nodes[node].kind->if_moved == IfMoved::FromChild)
      keepers_.push_back(node);
  }
}

void Symmetry::number_kept_children(const Tree& tree, std::vector<std::uint64_t>& words,
                                    Numbered by) const {
  for (const NodeIndex node : keepers_) {
    std::uint64_t& word = words[tree.nodes[node].state / sizeof word];
    NodeIndex child = 0;
    std::memcpy(&child, &word, sizeof child);
    if (child == 0) continue;
    child = by == Numbered::FromNode ? child - node : child + node;
    std::memcpy(&word, &child, sizeof child);
  }
}

std::vector<NodeIndex> Symmetry::exchange(NodeIndex node, NodeIndex other) const {
  std::vector<NodeIndex> places(first_like_.size());
  std::iota(places.begin(), places.end(), NodeIndex{0});
  // The outer ones first.
  for (auto it = classes_.rbegin(); it != classes_.rend(); ++it) {
    const auto child_with = [&](NodeIndex inside) {
      return std::ranges::find_if(it->places, [&](const EqualChildren::Place& place) {
        return place.node <= inside && inside < place.node + it->nodes;
      });
    };
    const auto from = child_with(places[node]), to = child_with(other);
    if (from == it->places.end() || to == it->places.end() || from == to) continue;
    for (NodeIndex& place : places) {
      if (place - from->node < it->nodes) {
        place = place - from->node + to->node;
      } else if (place - to->node < it->nodes) {
        place = place - to->node + from->node;
      }
    }
  }
  return places;
}

}  // namespace lockstep::host
