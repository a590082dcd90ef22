// Both trees as one, in rows.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "describe/tree_diff.h"
#include "describe/tree_drawing.h"

namespace lockstep::host {
namespace {

// So many siblings without a change are one row.
constexpr std::size_t kMostAlike = 4;

class Rows {
 public:
  explicit Rows(const TreeDiff& diff)
      : diff_(diff),
        a_(diff.trees[0]),
        b_(diff.trees[1]),
        to_new_(diff.matching.to_new),
        to_old_(diff.matching.to_old) {
    place_old();
    mark();
  }

  std::vector<DiffRow> take() {
    add_old(kNoNode, kNoNode, 0);
    std::vector<std::uint32_t> tops;
    for (std::uint32_t b = 0; b < to_old_.size(); b = b_.node(b).end) tops.push_back(b);
    add_all(kNoNode, tops, 0);
    // Backwards: the last row at each depth, until one that is less deep.
    std::vector<bool> is_open;
    for (auto row = rows_.rbegin(); row != rows_.rend(); ++row) {
      is_open.resize(row->depth + 1);
      row->is_last = !is_open[row->depth];
      is_open[row->depth] = true;
    }
    return std::move(rows_);
  }

 private:
  // Old nodes that are not in the new tree, or not there, by the new node that has the place of
  // their parent, and its child before them; kNoNode: none.
  void place_old() {
    for (std::uint32_t a = 0; a < to_new_.size(); ++a) {
      const bool is_gone = to_new_[a] == kNoNode;
      if (!is_gone && !diff_.is_moved[to_new_[a]]) continue;
      const bool is_top = a_.is_top(a);
      const std::uint32_t parent = is_top ? kNoNode : to_new_[a_.node(a).parent];
      if (!is_top && parent == kNoNode) continue;  // with its parent
      std::uint32_t before = kNoNode;
      const std::uint32_t first = is_top ? 0 : a_.node(a).parent + 1;
      for (std::uint32_t i = first; i < a; i = a_.node(i).end) {
        const std::uint32_t b = to_new_[i];
        if (b == kNoNode || diff_.is_moved[b]) continue;
        if (b_.is_top(b) ? is_top : b_.node(b).parent == parent) before = b;
      }
      old_[{parent, before}].push_back(a);
    }
  }

  void mark() {
    is_touched_.resize(to_old_.size());
    for (auto b = static_cast<std::uint32_t>(to_old_.size()); b-- > 0;) {
      const bool is_own = to_old_[b] == kNoNode || diff_.is_changed[b] || diff_.is_moved[b];
      const auto old = old_.lower_bound({b, 0});
      if (is_own || (old != old_.end() && old->first.first == b)) is_touched_[b] = true;
      if (is_touched_[b] && !b_.is_top(b)) is_touched_[b_.node(b).parent] = true;
    }
  }

  void add_old(std::uint32_t parent, std::uint32_t before, std::uint32_t depth) {
    const auto found = old_.find({parent, before});
    if (found == old_.end()) return;
    for (const std::uint32_t a : found->second) {
      if (to_new_[a] == kNoNode) {
        add_gone(a, depth);
      } else {
        rows_.push_back({.depth = depth, .sign = '<', .old_node = a, .new_node = to_new_[a]});
      }
    }
  }

  void add_gone(std::uint32_t a, std::uint32_t depth) {
    rows_.push_back({.depth = depth, .sign = '-', .old_node = a});
    for (std::uint32_t i = a + 1; i < a_.node(a).end; i = a_.node(i).end) {
      if (to_new_[i] == kNoNode) add_gone(i, depth + 1);
    }
  }

  void add_all(std::uint32_t parent, const std::vector<std::uint32_t>& children,
               std::uint32_t depth) {
    for (std::size_t i = 0; i < children.size();) {
      // Those without a change that come one after the other.
      std::size_t last = i;
      std::uint32_t nodes = 0;
      while (last < children.size() && !is_touched_[children[last]]) {
        nodes += b_.size(children[last]);
        if (old_.contains({parent, children[last++]})) break;
      }
      if (last - i > kMostAlike) {
        rows_.push_back({.depth = depth, .hidden = nodes});
        add_old(parent, children[last - 1], depth);
        i = last;
        continue;
      }
      add(children[i], depth);
      add_old(parent, children[i], depth);
      ++i;
    }
  }

  void add(std::uint32_t b, std::uint32_t depth) {
    const bool is_new = to_old_[b] == kNoNode;
    const char sign = is_new ? '+' : diff_.is_moved[b] ? '>' : diff_.is_changed[b] ? '~' : ' ';
    rows_.push_back({.depth = depth, .sign = sign, .old_node = to_old_[b], .new_node = b});
    if (b_.size(b) == 1) return add_old(b, kNoNode, depth + 1);
    bool has_touched = old_.contains({b, kNoNode});
    std::vector<std::uint32_t> children;
    for (std::uint32_t i = b + 1; i < b_.node(b).end; i = b_.node(i).end) {
      children.push_back(i);
      has_touched |= is_touched_[i] || old_.contains({b, i});
    }
    if (!has_touched) {
      rows_.back().hidden = b_.size(b) - 1;
      return;
    }
    const auto [drawn, is_first] = drawn_.emplace(
        std::tuple(b_.whole[b], is_new ? 0 : a_.whole[to_old_[b]], b_.node(b).place.byte), b);
    if (!is_first) {
      rows_.back().alike = drawn->second;
      return;
    }
    add_old(b, kNoNode, depth + 1);
    add_all(b, children, depth + 1);
  }

  const TreeDiff& diff_;
  const MatchedTree &a_, &b_;
  const std::vector<std::uint32_t>&to_new_, &to_old_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> old_;
  std::map<std::tuple<std::uint64_t, std::uint64_t, std::uint32_t>, std::uint32_t> drawn_;
  std::vector<bool> is_touched_;  // of the new nodes: a change is there or below
  std::vector<DiffRow> rows_;
};

}  // namespace

std::vector<DiffRow> rows_of(const TreeDiff& diff) {
  return Rows(diff).take();
}

std::string text_of(const std::vector<ValueChange>& values) {
  std::vector<std::string> texts;
  for (const ValueChange& it : values) {
    const std::string name = it.name.empty() ? "" : it.name + ' ';
    if (it.old_value.empty()) {
      texts.push_back(fmt::format("{}{} added", name, printable(it.new_value)));
    } else if (it.new_value.empty()) {
      texts.push_back(fmt::format("{}{} removed", name, printable(it.old_value)));
    } else {
      texts.push_back(
          fmt::format("{}{} → {}", name, printable(it.old_value), printable(it.new_value)));
    }
  }
  return joined(texts, ", ");
}

std::string text_of_node(const Definition& definition, const DefinitionNode& node) {
  std::string text(node.type->id);
  if (is_named(definition, node)) text += fmt::format(" '{}'", printable(node.name));
  for (const std::string& attribute : shown_attributes(definition, node)) text += " " + attribute;
  return text;
}

std::string text_of(const TreeDiff& diff, const DiffRow& row) {
  const auto& [a, b] = diff.trees;
  if (row.new_node == kNoNode && row.old_node == kNoNode) {
    return fmt::format("… {}", counted(row.hidden, "node"));
  }
  std::string text = row.new_node != kNoNode && row.sign != '<'
                         ? text_of_node(b.definition, b.node(row.new_node))
                         : text_of_node(a.definition, a.node(row.old_node));
  if (row.sign == '<') text += fmt::format("  (to {})", printable(b.paths[row.new_node]));
  if (row.sign == '>') text += fmt::format("  (from {})", printable(a.paths[row.old_node]));
  if (row.new_node != kNoNode && row.old_node != kNoNode && row.sign != '<' &&
      diff.is_changed[row.new_node]) {
    const auto& old_node = a.node(row.old_node);
    const auto& new_node = b.node(row.new_node);
    if (old_node.name != new_node.name &&
        (is_named(a.definition, old_node) || is_named(b.definition, new_node))) {
      text += fmt::format("  (was '{}')", printable(old_node.name));
    }
    const auto values = compare_values(a.definition, old_node, b.definition, new_node);
    if (!values.empty()) text += fmt::format("  ({})", text_of(values));
  }
  if (row.alike != kNoNode) text += fmt::format("  … as {}", printable(b.paths[row.alike]));
  if (row.hidden > 0) text += fmt::format("  … {}", counted(row.hidden, "node"));
  return text;
}

}  // namespace lockstep::host
