#include "measure/measuring.h"

#include <algorithm>

#include "measure/measure_spec.h"

namespace lockstep {
namespace {

bool is_parallel(const MeasuredTree::Node& node) {
  return compares_progress(node.synchronization) || node.kind == "Parallel";
}

// The name of a type whose values are numbers; those of a bool are 1 and 0.
bool is_number(std::string_view type) {
  constexpr ValueType kTypes[] = {ValueType::Bool, ValueType::Int, ValueType::Double,
                                  ValueType::Number};
  return std::ranges::any_of(kTypes, [&](ValueType it) { return type == to_string(it); });
}

}  // namespace

Measuring::Measuring(const MeasuredTree& tree, std::span<const MeasureSpec> specs) {
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
      case MeasureOf::Node:
        add_node(spec, tree);
        break;
      case MeasureOf::Entry:
        add_entry(spec, tree);
        break;
    }
    if (!error_.empty()) return;
  }
}

void Measuring::add(const MeasureSpec& spec, std::string node, const MeasureTarget& target) {
  columns_.push_back({&spec, std::move(node)});
  accumulators_.push_back(spec.measure->make(spec, target));
}

MeasureTarget Measuring::target_of(const MeasuredTree& tree, NodeIndex parallel) {
  const auto [place, is_new] = places_.try_emplace(parallel, parallels_.size());
  if (is_new) parallels_.push_back(parallel);
  return {.place = place->second, .children = tree.nodes[parallel].children.size()};
}

void Measuring::add_parallels(const MeasureSpec& spec, const MeasuredTree& tree) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (is_parallel(tree.nodes[node])) add(spec, tree.paths[node], target_of(tree, node));
  }
}

void Measuring::add_child(const MeasureSpec& spec, const MeasuredTree& tree) {
  const auto node = find_path(tree.paths, spec.name);
  if (!node) {
    error_ = node.error().message;
    return;
  }
  for (NodeIndex keeper = 0; keeper < tree.nodes.size(); ++keeper) {
    if (tree.nodes[keeper].synchronization == Synchronization::None) continue;
    const auto& children = tree.nodes[keeper].children;
    // A SyncProgress stands for its child.
    const auto child = std::ranges::find_if(children, [&](NodeIndex held) {
      const NodeIndex around = tree.nodes[held].parent;
      return held == *node || (around == *node && around != keeper);
    });
    if (child == children.end()) continue;
    needs_held_ = true;
    MeasureTarget target = target_of(tree, keeper);
    target.child = static_cast<std::size_t>(child - children.begin());
    add(spec, tree.paths[*node], target);
    return;
  }
  error_ = "'" + tree.paths[*node] +
           "' is not a child of a synchronized node, of a SyncProgress or of a UseResources, so it "
           "is never held";
}

void Measuring::add_node(const MeasureSpec& spec, const MeasuredTree& tree) {
  const auto node = find_path(tree.paths, spec.name);
  if (!node) {
    error_ = node.error().message;
    return;
  }
  add(spec, tree.paths[*node], {.place = nodes_.size()});
  nodes_.push_back(static_cast<NodeIndex>(*node));
}

void Measuring::add_entry(const MeasureSpec& spec, const MeasuredTree& tree) {
  const auto entry = find_path(tree.entries, spec.name, "entry");
  if (!entry) {
    error_ = entry.error().message;
    return;
  }
  const std::string& type = tree.entry_types[*entry];
  if (!is_number(type)) {
    error_ = "the entry '" + tree.entries[*entry] + "' is a " + type + ", expected a number";
    return;
  }
  add(spec, tree.id, {.place = entries_.size()});
  entries_.push_back(*entry);
}

void Measuring::reset() {
  for (auto& accumulator : accumulators_) accumulator->reset();
}

void Measuring::after_tick(const TickView& view) {
  for (auto& accumulator : accumulators_) accumulator->after_tick(view);
}

double Measuring::value(std::size_t column, const EndView& end) const {
  return accumulators_[column]->value(end);
}

}  // namespace lockstep
