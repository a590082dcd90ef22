#include "describe/tree_diff.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace lockstep::host {
namespace {

// Of each node the nearest one above it that has a partner; kNoNode: there is none.
std::vector<std::uint32_t> matched_parents(const MatchedTree& tree,
                                           const std::vector<std::uint32_t>& partners) {
  std::vector<std::uint32_t> parents(partners.size(), kNoNode);
  for (std::uint32_t i = 0; i < partners.size(); ++i) {
    if (tree.is_top(i)) continue;
    const std::uint32_t parent = tree.node(i).parent;
    parents[i] = partners[parent] != kNoNode ? parent : parents[parent];
  }
  return parents;
}

// Of each of these numbers, whether it is in a longest increasing row of them.
std::vector<bool> in_order(const std::vector<std::uint32_t>& numbers) {
  std::vector<std::size_t> ends, before(numbers.size());
  constexpr std::size_t kFirst = static_cast<std::size_t>(-1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto place =
        std::ranges::lower_bound(ends, numbers[i], {}, [&](std::size_t it) { return numbers[it]; });
    before[i] = place == ends.begin() ? kFirst : *(place - 1);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<bool> are(numbers.size());
  for (std::size_t i = ends.empty() ? kFirst : ends.back(); i != kFirst; i = before[i]) {
    are[i] = true;
  }
  return are;
}

std::uint32_t number_of_child(const MatchedTree& tree, std::uint32_t index) {
  std::uint32_t number = 1;
  for (std::uint32_t i = tree.node(index).parent + 1; i < index; i = tree.node(i).end) ++number;
  return number;
}

std::string shown(const NodeValue& value) {
  if (value.is_written) return value.shown.empty() ? "\"\"" : value.shown;
  return value.shown + " (default)";
}

}  // namespace

std::vector<ValueChange> compare_values(const Definition& a, const DefinitionNode& of_a,
                                        const Definition& b, const DefinitionNode& of_b) {
  std::vector<ValueChange> changes;
  if (of_a.type->id != of_b.type->id) {
    changes.push_back({"", std::string(of_a.type->id), std::string(of_b.type->id)});
  }
  const auto values_a = values_of(a, of_a), values_b = values_of(b, of_b);
  for (const NodeValue& it : values_a) {
    const auto other = std::ranges::find(values_b, it.name, &NodeValue::name);
    const bool is_there = other != values_b.end();
    if (!it.is_written && (!is_there || !other->is_written)) continue;
    if (is_there && it.text == other->text) continue;
    changes.push_back({std::string(it.name), shown(it), is_there ? shown(*other) : ""});
  }
  for (const NodeValue& it : values_b) {
    if (!it.is_written || std::ranges::find(values_a, it.name, &NodeValue::name) != values_a.end())
      continue;
    changes.push_back({std::string(it.name), "", shown(it)});
  }
  return changes;
}

std::string_view to_string(TreeChangeKind kind) {
  constexpr std::string_view kNames[] = {"changed", "renamed", "moved", "new", "gone"};
  return kNames[static_cast<unsigned>(kind)];
}

class TreeDiff::Finder {
 public:
  explicit Finder(TreeDiff& diff)
      : diff_(diff),
        a_(diff.trees[0]),
        b_(diff.trees[1]),
        to_new_(diff.matching.to_new),
        to_old_(diff.matching.to_old),
        parents_a_(matched_parents(a_, to_new_)),
        parents_b_(matched_parents(b_, to_old_)) {}

  void find() {
    find_moved();
    std::uint32_t b = 0;
    for (std::uint32_t a = 0; a < to_new_.size(); ++a) {
      if (to_new_[a] != kNoNode) continue;
      if (!a_.is_top(a) && to_new_[a_.node(a).parent] == kNoNode) continue;
      gone_.push_back(a);
    }
    auto gone = gone_.begin();
    for (; b < to_old_.size(); ++b) {
      compare_node(b);
      // What is gone comes behind the node before it.
      for (; gone != gone_.end() && is_behind(*gone, b); ++gone) add_gone(*gone);
    }
    for (; gone != gone_.end(); ++gone) add_gone(*gone);
    compare_properties();
  }

 private:
  bool is_behind(std::uint32_t gone, std::uint32_t b) const {
    for (std::uint32_t a = gone; a-- > 0;) {
      if (to_new_[a] != kNoNode) return to_new_[a] <= b;
    }
    return true;
  }

  void find_moved() {
    diff_.is_moved.resize(to_old_.size());
    diff_.is_changed.resize(to_old_.size());
    std::map<std::uint32_t, std::vector<std::uint32_t>> children;  // by the old parent
    for (std::uint32_t b = 0; b < to_old_.size(); ++b) {
      const std::uint32_t a = to_old_[b];
      if (a == kNoNode || parents_b_[b] == kNoNode || parents_a_[a] == kNoNode) continue;
      if (to_new_[parents_a_[a]] == parents_b_[b]) {
        children[parents_a_[a]].push_back(a);
      } else {
        diff_.is_moved[b] = true;
      }
    }
    for (const auto& [parent, of_parent] : children) {
      const auto are = in_order(of_parent);
      for (std::size_t i = 0; i < are.size(); ++i) {
        if (!are[i]) diff_.is_moved[to_new_[of_parent[i]]] = true;
      }
    }
    // One that was at the top and is below a node that stays, or the other way round.
    for (std::uint32_t b = 0; b < to_old_.size(); ++b) {
      const std::uint32_t a = to_old_[b];
      if (a != kNoNode && (parents_b_[b] == kNoNode) != (parents_a_[a] == kNoNode))
        diff_.is_moved[b] = true;
    }
  }

  void compare_node(std::uint32_t b) {
    const std::uint32_t a = to_old_[b];
    if (a == kNoNode) {
      if (b_.is_top(b) || to_old_[b_.node(b).parent] != kNoNode) add_new(b);
      return;
    }
    const bool is_renamed =
        a_.node(a).name != b_.node(b).name &&
        (is_named(a_.definition, a_.node(a)) || is_named(b_.definition, b_.node(b)));
    if (is_renamed) add({.kind = TreeChangeKind::Renamed, .old_node = a, .new_node = b});
    if (diff_.is_moved[b]) {
      TreeChange change{.kind = TreeChangeKind::Moved, .old_node = a, .new_node = b};
      if (!a_.is_top(a) && !b_.is_top(b) && to_new_[a_.node(a).parent] == b_.node(b).parent) {
        change.old_child = number_of_child(a_, a);
        change.new_child = number_of_child(b_, b);
      }
      add(std::move(change));
    }
    if (a_.own[a] == b_.own[b]) return;
    auto values = compare_values(a_.definition, a_.node(a), b_.definition, b_.node(b));
    if (values.empty()) return;
    add({.kind = TreeChangeKind::Changed,
         .old_node = a,
         .new_node = b,
         .values = std::move(values)});
  }

  // The subtree of a node that has no partner, up to those that have one.
  static void count_below(const MatchedTree& tree, const std::vector<std::uint32_t>& partners,
                          std::uint32_t index, TreeChange& change) {
    for (std::uint32_t i = index + 1; i < tree.node(index).end;) {
      if (partners[i] == kNoNode) {
        ++change.below;
        ++i;
        continue;
      }
      if (change.around == kNoNode) change.around = i;
      i = tree.node(i).end;
    }
  }

  void add_new(std::uint32_t b) {
    TreeChange change{.kind = TreeChangeKind::New, .new_node = b};
    count_below(b_, to_old_, b, change);
    if (change.around != kNoNode) change.around = to_old_[change.around];
    add(std::move(change));
  }

  void add_gone(std::uint32_t a) {
    TreeChange change{.kind = TreeChangeKind::Gone, .old_node = a};
    count_below(a_, to_new_, a, change);
    add(std::move(change));
  }

  // Once, where a tree is used several times.
  void add(TreeChange change) {
    if (change.kind == TreeChangeKind::Changed || change.kind == TreeChangeKind::Renamed) {
      diff_.is_changed[change.new_node] = true;
    }
    using Key = std::tuple<TreeChangeKind, std::uint32_t, std::uint32_t, std::string>;
    const auto place = [](const MatchedTree& tree, std::uint32_t node) {
      return node == kNoNode ? kNoNode : tree.node(node).place.byte;
    };
    std::string values;
    for (const ValueChange& it : change.values) {
      values += it.name + '\n' + it.old_value + '\n' + it.new_value + '\n';
    }
    const auto [known, is_new] = known_.emplace(
        Key(change.kind, place(a_, change.old_node), place(b_, change.new_node), std::move(values)),
        diff_.changes.size());
    if (!is_new) {
      diff_.changes[known->second].also.push_back(diff_.path(change));
      return;
    }
    if (change.old_node != kNoNode) {
      change.old_place = diff_.sides[0].locate(a_.node(change.old_node).place);
    }
    if (change.new_node != kNoNode) {
      change.new_place = diff_.sides[1].locate(b_.node(change.new_node).place);
    }
    diff_.changes.push_back(std::move(change));
  }
  std::map<std::tuple<TreeChangeKind, std::uint32_t, std::uint32_t, std::string>, std::size_t>
      known_;

  void compare_properties() {
    const auto& of_a = a_.definition.properties;
    const auto& of_b = b_.definition.properties;
    const auto find = [](const auto& all, const WrittenProperty& it) {
      return std::ranges::find_if(all, [&](const WrittenProperty& other) {
        return it.name.empty() ? other.name.empty() && other.text == it.text
                               : other.name == it.name;
      });
    };
    for (const WrittenProperty& it : of_b) {
      const auto other = find(of_a, it);
      const bool is_there = other != of_a.end();
      if (is_there && other->text == it.text) continue;
      diff_.properties.push_back({std::string(it.name), is_there ? std::string(other->text) : "",
                                  std::string(it.text),
                                  is_there ? diff_.sides[0].locate(other->place) : SourceLocation(),
                                  diff_.sides[1].locate(it.place)});
    }
    for (const WrittenProperty& it : of_a) {
      if (find(of_b, it) != of_b.end()) continue;
      diff_.properties.push_back(
          {std::string(it.name), std::string(it.text), "", diff_.sides[0].locate(it.place), {}});
    }
  }

  TreeDiff& diff_;
  const MatchedTree &a_, &b_;
  const std::vector<std::uint32_t>&to_new_, &to_old_;
  const std::vector<std::uint32_t> parents_a_, parents_b_;
  std::vector<std::uint32_t> gone_;
};

TreeDiff::TreeDiff(TreeSide old_side, TreeSide new_side)
    : sides{std::move(old_side), std::move(new_side)},
      trees{MatchedTree(*sides[0].definition), MatchedTree(*sides[1].definition)},
      matching(match(trees[0], trees[1])) {
  Finder(*this).find();
}

}  // namespace lockstep::host
