#include "tree/advise/dry_tree.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "base/core/pre_order.h"

namespace lockstep::host {
namespace {

using Kind = DryNode::Kind;

class DryTreeBuilder {
 public:
  explicit DryTreeBuilder(const Definition& definition) : definition_(definition) {}

  DryTree build() {
    if (!find_members()) return {};
    for (std::uint32_t node = count(); node-- > 0;) describe(node);
    for (std::uint32_t node = 0; node < count();) node = add(node);
    close(count());
    return std::move(tree_);
  }

 private:
  // The properties of a node and of all that is in it.
  struct Conduct {
    std::uint32_t keeper = DryNode::kNone;  // of a member: its barrier
    bool has_member : 1 = false;
    bool has_action : 1 = false;
    bool can_run : 1 = false;  // returns Running
    bool is_sure : 1 = true;   // all of its children run, and it succeeds when they do
    double last = 0;           // the progress from which it jumps to 1

    bool is_at_once() const { return !can_run || !has_action; }
  };

  // A node whose children are being added.
  struct Open {
    std::uint32_t index;                    // in the dry tree
    std::uint32_t end;                      // in the definition
    std::uint32_t keeper = DryNode::kNone;  // of its children
    std::uint32_t children = 0;             // so far
    std::uint32_t plain = DryNode::kNone;   // the one that stands for those without members
  };

  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }
  std::uint32_t count() const { return at(0).end; }

  bool find_members() {
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group)) continue;
      conducts_.resize(count());
      const std::uint32_t keeper = add_keeper(group.node, definition_.waits(group));
      for (const std::uint32_t member : group.members) {
        conducts_[member].has_member = true;
        conducts_[member].keeper = keeper;
      }
    }
    return !tree_.keepers.empty();
  }

  // Children come before their parents: they are behind them in pre-order.
  void describe(std::uint32_t node) {
    Conduct& it = conducts_[node];
    const NodeType& type = *at(node).type;
    it.has_action |= type.category == NodeCategory::Action;
    it.can_run |= type.can_run;
    it.is_sure = is_sure(node);
    it.last = last(node);
    if (node == 0) return;
    Conduct& around = conducts_[at(node).parent];
    around.has_member |= it.has_member;
    around.has_action |= it.has_action;
    around.can_run |= it.can_run;
  }

  bool is_sure(std::uint32_t node) const {
    const NodeType& type = *at(node).type;
    if (decides_by_script(node)) return false;
    if (at(node).children == 0) return true;
    if (!type.plugin.empty()) return false;
    if (type.category != NodeCategory::Control) return times(node) >= 0;
    if (type.goes_on_after == Status::Success) return true;
    return type.latches && !definition_.forgets(at(node)) && needs_all(node);
  }

  // A script may end the node without a tick, or leave it out.
  bool decides_by_script(std::uint32_t node) const {
    if (at(node).hooks >= definition_.hooks.size()) return false;
    constexpr auto kAfterwards = static_cast<std::size_t>(Hook::OnSuccess);
    return std::ranges::any_of(std::span(definition_.hooks[at(node).hooks]).first(kAfterwards),
                               [](std::uint32_t script) { return script != Port::kNone; });
  }

  bool needs_all(std::uint32_t node) const {
    const Value* given = definition_.constant(at(node), "success_count");
    return given != nullptr && *given == Value(std::int64_t{at(node).children});
  }

  // How often a Repeat runs its child; 1 for other nodes and one that repeats for ever, of which
  // only the first round matters; negative: an entry says it.
  std::int64_t times(std::uint32_t node) const {
    if (at(node).type->progress_share != ProgressShare::EachRound) return 1;
    const std::optional<std::int64_t> rounds = definition_.rounds(at(node));
    return rounds ? std::max(*rounds, std::int64_t{1}) : -1;
  }

  Kind kind(std::uint32_t node) const {
    const NodeType& type = *at(node).type;
    if (at(node).children == 0) return Kind::Leaf;
    if (type.category != NodeCategory::Control) {
      return times(node) > 1 ? Kind::Rounds : Kind::Around;
    }
    return type.goes_on_after == Status::Success ? Kind::Sequence : Kind::All;
  }

  // A leaf that reports progress may be anywhere before it succeeds; one that does not is at 0.
  double last(std::uint32_t node) const {
    if (conducts_[node].is_at_once()) return 0;
    if (!conducts_[node].is_sure) return 1;
    switch (kind(node)) {
      case Kind::Leaf:
        return at(node).type->has_progress ? 1 : 0;
      case Kind::Sequence:
        return last_of_sequence(node);
      case Kind::Rounds:
        return 1 - (1 - last_of_children(node)) / static_cast<double>(times(node));
      case Kind::Around:
      case Kind::All:
        return last_of_children(node);
    }
    return 1;
  }

  double last_of_sequence(std::uint32_t node) const {
    double last = 0, place = 0;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      const Conduct& it = conducts_[child];
      if (!it.is_at_once()) last = (place + it.last) / at(node).children;
      ++place;
    }
    return last;
  }

  double last_of_children(std::uint32_t node) const {
    double last = 0;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      last = std::max(last, conducts_[child].last);
    }
    return last;
  }

  // Returns the node to add next.
  std::uint32_t add(std::uint32_t node) {
    close(node);
    const Conduct& conduct = conducts_[node];
    if (is_left_out(node)) return at(node).end;
    const bool is_leaf = !conduct.has_member || !conduct.is_sure;
    const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.push_back({.kind = is_leaf ? Kind::Leaf : kind(node),
                           .node = node,
                           .end = index + 1,
                           .parent = open_.empty() ? 0 : open_.back().index,
                           .last = conduct.last,
                           .at_once = conduct.is_at_once()});
    if (!open_.empty()) join(index);
    if (is_leaf) return at(node).end;
    open_.push_back({.index = index, .end = at(node).end, .keeper = keeper_in(node)});
    return node + 1;
  }

  // Children without members that run at the same time are all alike, so one stands for all.
  bool is_left_out(std::uint32_t node) {
    const Conduct& conduct = conducts_[node];
    if (open_.empty() || conduct.has_member) return false;
    Open& around = open_.back();
    if (tree_.nodes[around.index].kind != Kind::All) return false;
    if (conduct.is_at_once()) return true;
    const bool is_first = around.plain == DryNode::kNone;
    if (is_first) around.plain = static_cast<std::uint32_t>(tree_.nodes.size());
    if (!is_first) {
      double& last = tree_.nodes[around.plain].last;
      last = std::max(last, conduct.last);
    }
    return !is_first;
  }

  // Beside the children of `open_.back()` that are there.
  void join(std::uint32_t index) {
    Open& around = open_.back();
    const DryNode& parent = tree_.nodes[around.index];
    DryNode& it = tree_.nodes[index];
    if (parent.kind == Kind::Sequence) {
      it.place = static_cast<double>(around.children++);
      it.parts = static_cast<double>(at(parent.node).children);
    } else if (parent.kind == Kind::Rounds) {
      it.parts = static_cast<double>(times(parent.node));
    }
    it.keeper = around.keeper;
    if (it.keeper != DryNode::kNone) tree_.keepers[it.keeper].kept.push_back(index);
  }

  void close(std::uint32_t node) {
    while (!open_.empty() && open_.back().end <= node) {
      tree_.nodes[open_.back().index].end = static_cast<std::uint32_t>(tree_.nodes.size());
      open_.pop_back();
    }
  }

  // The keeper that holds the children of that node.
  std::uint32_t keeper_in(std::uint32_t node) {
    if (!compares_progress(at(node).type->synchronization)) return conducts_[node].keeper;
    return add_keeper(node, true);
  }

  // None where it never holds anybody.
  std::uint32_t add_keeper(std::uint32_t node, bool waits_for_idle) {
    DryKeeper keeper{.node = node, .waits_for_idle = waits_for_idle};
    if (definition_.synchronization(at(node)) == Synchronization::Relative) {
      const Value* delta = definition_.constant(at(node), "delta");
      if (delta == nullptr || std::get<double>(*delta) >= 1) return DryNode::kNone;
      keeper.delta = std::get<double>(*delta);
    } else {
      const Value* barriers = definition_.constant(at(node), "barriers");
      const Value* at_barrier = definition_.constant(at(node), "at_barrier");
      if (barriers == nullptr || at_barrier == nullptr) return DryNode::kNone;
      keeper.barriers = &std::get<std::vector<double>>(*barriers);
      keeper.ticks_at_barrier = *at_barrier == Value("tick");
      if (keeper.barriers->empty()) return DryNode::kNone;
    }
    tree_.keepers.push_back(std::move(keeper));
    return static_cast<std::uint32_t>(tree_.keepers.size() - 1);
  }

  const Definition& definition_;
  std::vector<Conduct> conducts_;
  std::vector<Open> open_;
  DryTree tree_;
};

}  // namespace

DryTree dry_tree(const Definition& definition) {
  return DryTreeBuilder(definition).build();
}

}  // namespace lockstep::host
