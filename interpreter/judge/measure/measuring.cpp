#include "judge/measure/measuring.h"

#include <algorithm>
#include <optional>

#include "judge/measure/measure_spec.h"

namespace lockstep::host {
namespace {

bool is_parallel(const ShapeNode& node) {
  return compares_progress(node.synchronization) || node.latches;
}

// The name of a type whose values are numbers; those of a bool are 1 and 0.
bool is_number(std::string_view type) {
  constexpr ValueType kTypes[] = {ValueType::Bool, ValueType::Int, ValueType::Double,
                                  ValueType::Number};
  return std::ranges::any_of(kTypes, [&](ValueType it) { return type == to_string(it); });
}

// A node, and who may hold it.
struct Kept {
  NodeIndex keeper = 0;
  std::size_t child = 0;  // its place among the children of the keeper
};

// By the first one that may. A SyncProgress stands for its child.
std::optional<Kept> find_kept(const Shape& tree, std::size_t node) {
  for (NodeIndex keeper = 0; keeper < tree.nodes.size(); ++keeper) {
    if (tree.nodes[keeper].synchronization == Synchronization::None) continue;
    const auto& children = tree.nodes[keeper].held();
    const auto child = std::ranges::find_if(children, [&](NodeIndex held) {
      const NodeIndex around = tree.nodes[held].parent.value_or(held);
      return held == node || (around == node && around != keeper);
    });
    if (child == children.end()) continue;
    return Kept{.keeper = keeper, .child = static_cast<std::size_t>(child - children.begin())};
  }
  return std::nullopt;
}

// Nodes to choose from by the ends of their paths.
class Choice {
 public:
  explicit Choice(const Shape& tree) : tree_(tree), is_in_(tree.nodes.size()) {}

  // `node` is named, `what` is meant. The first for a node counts.
  void add(NodeIndex node, NodeIndex what) {
    if (is_in_[node]) return;
    is_in_[node] = true;
    paths.push_back(tree_.nodes[node].path);
    meant.push_back(what);
  }

  std::vector<std::string> paths;
  std::vector<NodeIndex> meant;

 private:
  const Shape& tree_;
  std::vector<bool> is_in_;
};

// The other children of a keeper, by their places among them.
Choice neighbors(const Shape& tree, const Kept& kept) {
  Choice choice(tree);
  const auto& children = tree.nodes[kept.keeper].held();
  for (NodeIndex other = 0; other < children.size(); ++other) {
    if (other == kept.child) continue;
    choice.add(children[other], other);
    const NodeIndex around = tree.nodes[children[other]].parent.value_or(children[other]);
    if (around != kept.keeper) choice.add(around, other);
  }
  return choice;
}

Choice all_parallels(const Shape& tree) {
  Choice choice(tree);
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (is_parallel(tree.nodes[node])) choice.add(node, node);
  }
  return choice;
}

Choice all_pools(const Shape& tree) {
  Choice choice(tree);
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (tree.nodes[node].synchronization == Synchronization::Resources) choice.add(node, node);
  }
  return choice;
}

// The nodes that use resources of a pool are the parents of what it holds.
std::vector<NodeIndex> users_of(const Shape& tree, NodeIndex pool) {
  std::vector<NodeIndex> users;
  for (const NodeIndex child : tree.nodes[pool].held()) {
    users.push_back(tree.nodes[child].parent.value_or(child));
  }
  return users;
}

// The users of all pools. One also goes by its child, which often has the better name.
Choice all_users(const Shape& tree) {
  Choice choice(tree);
  const Choice all = all_pools(tree);
  for (const NodeIndex pool : all.meant) {
    for (const NodeIndex user : users_of(tree, pool)) choice.add(user, user);
  }
  for (const NodeIndex pool : all.meant) {
    for (const NodeIndex child : tree.nodes[pool].held()) {
      choice.add(child, tree.nodes[child].parent.value_or(child));
    }
  }
  return choice;
}

}  // namespace

Measuring::Measuring(const Shape& tree, std::span<const MeasureSpec> specs) {
  for (const MeasureSpec& spec : specs) {
    switch (spec.measure->of) {
      case MeasureOf::Run:
        add(spec, tree.id, {});
        break;
      case MeasureOf::Parallel:
        add_parallels(spec, tree);
        break;
      case MeasureOf::Child:
        add_child(spec, tree);
        break;
      case MeasureOf::Pair:
        add_pair(spec, tree);
        break;
      case MeasureOf::User:
        add_user(spec, tree);
        break;
      case MeasureOf::Pool:
        add_pool(spec, tree);
        break;
      case MeasureOf::Node:
        add_node(spec, tree);
        break;
      case MeasureOf::Entry:
        add_entry(spec, tree);
        break;
    }
    if (!error_.empty()) return;
  }
  for (const NodeIndex node : asked_.parallels) parallels_.emplace_back(tree, node, needs_flags_);
  ticks_.resize(parallels_.size());
}

void Measuring::add(const MeasureSpec& spec, std::string node, const MeasureTarget& target) {
  columns_.push_back({&spec, std::move(node)});
  needs_flags_ |= spec.measure->sees_success;
  accumulators_.push_back(spec.measure->make(spec, target));
}

std::optional<std::size_t> Measuring::found(Result<std::size_t> place) {
  if (place) return *place;
  error_ = place.error().message;
  return std::nullopt;
}

MeasureTarget Measuring::target_of(const Shape& tree, NodeIndex parallel) {
  const auto [place, is_new] = places_.try_emplace(parallel, asked_.parallels.size());
  if (is_new) asked_.parallels.push_back(parallel);
  return {.place = place->second, .children = tree.nodes[parallel].held().size()};
}

void Measuring::add_parallels(const MeasureSpec& spec, const Shape& tree) {
  const Choice all = all_parallels(tree);
  const auto add_one = [&](NodeIndex node) {
    add(spec, tree.nodes[node].path, target_of(tree, node));
  };
  if (spec.name.empty()) return std::ranges::for_each(all.meant, add_one), void();
  if (const auto place = found(find_path(all.paths, spec.name, "parallel or barrier"))) {
    add_one(all.meant[*place]);
  }
}

void Measuring::add_child(const MeasureSpec& spec, const Shape& tree) {
  const auto node = found(find_path(paths_of(tree), spec.name));
  if (!node) return;
  const auto kept = find_kept(tree, *node);
  if (!kept) {
    error_ = "'" + tree.nodes[*node].path +
             "' is not a child of a synchronized node, of a SyncProgress or of a UseResources, so "
             "it is never held";
    return;
  }
  needs_flags_ = true;
  MeasureTarget target = target_of(tree, kept->keeper);
  target.child = kept->child;
  add(spec, tree.nodes[*node].path, target);
}

void Measuring::add_pair(const MeasureSpec& spec, const Shape& tree) {
  const auto node = found(find_path(paths_of(tree), spec.name));
  if (!node) return;
  const std::string& path = tree.nodes[*node].path;
  const auto kept = find_kept(tree, *node);
  if (!kept || !compares_progress(tree.nodes[kept->keeper].synchronization)) {
    error_ = "'" + path +
             "' is not a child of a synchronized node or of a SyncProgress, so no other child "
             "holds it";
    return;
  }
  const Choice others = neighbors(tree, *kept);
  const auto other =
      found(find_path(others.paths, spec.other, "child next to '" + path + "' named"));
  if (!other) return;
  needs_flags_ = true;
  MeasureTarget target = target_of(tree, kept->keeper);
  target.child = kept->child;
  target.other = others.meant[*other];
  add(spec, path, target);
}

void Measuring::add_user(const MeasureSpec& spec, const Shape& tree) {
  const Choice choice = all_users(tree);
  const auto user = found(find_path(choice.paths, spec.name, "UseResources"));
  if (!user) return;
  const NodeIndex node = choice.meant[*user];
  add(spec, tree.nodes[node].path, {.nodes = {node}});
}

void Measuring::add_pool(const MeasureSpec& spec, const Shape& tree) {
  const Choice choice = all_pools(tree);
  const auto pool = found(find_path(choice.paths, spec.name, "pool"));
  if (!pool) return;
  add(spec, choice.paths[*pool], {.nodes = users_of(tree, choice.meant[*pool])});
}

void Measuring::add_node(const MeasureSpec& spec, const Shape& tree) {
  const auto node = found(find_path(paths_of(tree), spec.name));
  if (!node) return;
  const auto index = static_cast<NodeIndex>(*node);
  add(spec, tree.nodes[index].path, {.nodes = path_to_root(tree, index)});
  asked_.progress.push_back(index);
}

void Measuring::add_entry(const MeasureSpec& spec, const Shape& tree) {
  std::vector<std::string> keys;
  for (const ShapeEntry& it : tree.entries) keys.push_back(it.key);
  const auto entry = found(find_path(keys, spec.name, "entry"));
  if (!entry) return;
  const std::string& type = tree.entries[*entry].type;
  if (!is_number(type)) {
    error_ = "the entry '" + keys[*entry] + "' is a " + type + ", expected a number";
    return;
  }
  add(spec, tree.id, {.entry = *entry});
}

void Measuring::reset() {
  for (auto& accumulator : accumulators_) accumulator->reset();
}

void Measuring::join(Joint joint) {
  for (auto& accumulator : accumulators_) accumulator->join(joint);
}

void Measuring::after_tick(const Moment& moment) {
  SynchronizedTick* next = ticks_.data();
  for (SynchronizedTicks& parallel : parallels_) parallel.read(moment, *next++);
  const TickView view{.moment = &moment, .parallels = ticks_};
  for (auto& accumulator : accumulators_) accumulator->after_tick(view);
}

double Measuring::value(std::size_t column, const EndView& end) const {
  return accumulators_[column]->value(end);
}

}  // namespace lockstep::host
