#include "author/convert/circumstances.h"

#include <algorithm>
#include <ranges>

#include "base/core/pre_order.h"
#include "base/core/value.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

constexpr int kMostNested = 4000;  // behind SubTrees, too

// Its children are held at times.
bool is_synchronized(std::string_view type) {
  constexpr std::string_view kTypes[] = {"ParallelAbsolute", "ParallelRelative", "SyncProgress",
                                         "UseResources"};
  return std::ranges::find(kTypes, type) != std::end(kTypes);
}

}  // namespace

Circumstances::Circumstances(const Document& document, const Conversion& conversion)
    : document_(document),
      conversion_(conversion),
      elements_(document.elements()),
      is_held_(elements_.size()),
      runs_(elements_.size()),
      skips_(elements_.size()) {
  for (const std::uint32_t part : children_in(elements_, 0)) {
    const Attribute* id = document_.find_attribute(part, "ID");
    if (elements_[part].tag == "BehaviorTree" && id != nullptr) trees_.emplace(id->value, part);
    if (elements_[part].tag != "TreeNodesModel") continue;
    for (const std::uint32_t model : children_in(elements_, part)) {
      const Attribute* of_model = document_.find_attribute(model, "ID");
      if (of_model == nullptr) continue;
      modeled_.insert(of_model->value);
      if (elements_[model].tag == "Action") modeled_actions_.insert(of_model->value);
    }
  }
  find_held();
}

bool Circumstances::apply(btcpp::When when, std::uint32_t element) {
  const std::uint32_t first = element + 1;
  const bool has_child = first < elements_[element].end;
  switch (when) {
    case btcpp::When::Always:
      return true;
    case btcpp::When::IsHeld:
      return is_held_[element];
    case btcpp::When::ConditionRuns:
      return has_child && may_run(first);
    case btcpp::When::LeafMayRun:
      return has_child && !may_run(first) && has_unknown_leaf(first);
    case btcpp::When::FirstIsSkipped:
      return has_child && skips(first) == Skips::Script;
    case btcpp::When::LeafSkipsFirst:
      return has_child && skips(first) == Skips::Leaf;
    case btcpp::When::FirstIsDecided:
      return has_child && is_decided_by_script(first);
  }
  return true;
}

bool Circumstances::passes_on_all(std::uint32_t subtree) const {
  // The others are of version 3.
  constexpr std::string_view kNames[] = {"_autoremap", "__autoremap", "__shared_blackboard"};
  return std::ranges::any_of(kNames, [&](std::string_view name) {
    const Attribute* it = document_.find_attribute(subtree, name);
    return it != nullptr && parse_flag(it->value) == true;
  });
}

std::string_view Circumstances::type_of(std::uint32_t element) const {
  const std::string_view tag = elements_[element].tag;
  const Attribute* id = is_explicit_tag(tag) ? document_.find_attribute(element, "ID") : nullptr;
  return id == nullptr ? tag : id->value;
}

std::uint32_t Circumstances::tree_of(std::uint32_t subtree) const {
  const Attribute* id = document_.find_attribute(subtree, "ID");
  const std::string_view type = elements_[subtree].tag;
  if (id == nullptr || (type != "SubTree" && type != "SubTreePlus")) return 0;
  const auto tree = trees_.find(id->value);
  return tree == trees_.end() ? 0 : tree->second;
}

bool Circumstances::has_script(std::uint32_t element, Hook hook) const {
  const auto is_it = [&](const Attribute& it) {
    return hook_named(it.name, conversion_.from) == hook;
  };
  return std::ranges::any_of(document_.attributes(element), is_it);
}

void Circumstances::find_held() {
  std::vector<std::uint32_t> subtrees;  // in what is held, whose trees are to be looked at
  const auto hold = [&](std::uint32_t element) {
    for (std::uint32_t it = element + 1; it < elements_[element].end; ++it) {
      if (!is_held_[it] && tree_of(it) != 0) subtrees.push_back(it);
      is_held_[it] = true;
    }
  };
  for (std::uint32_t element = 0; element < elements_.size(); ++element) {
    if (!is_held_[element] && is_synchronized(type_of(element))) hold(element);
  }
  while (!subtrees.empty()) {
    const std::uint32_t tree = tree_of(subtrees.back());
    subtrees.pop_back();
    if (tree + 1 < elements_[tree].end && !is_held_[tree + 1]) hold(tree);
  }
}

// Whether something in it, or in a tree that it uses, may run for several ticks.
bool Circumstances::may_run(std::uint32_t element) {
  return std::ranges::any_of(std::views::iota(element, elements_[element].end),
                             [&](auto node) { return may_run_itself(node); });
}

bool Circumstances::may_run_itself(std::uint32_t node) {
  if (const std::uint32_t tree = tree_of(node); tree != 0) return tree_may_run(tree);
  const NodeType* known = conversion_.from_nodes.find(type_of(node));
  // The actions of a tree in another file are not seen.
  if (known != nullptr) return known->can_run || known->category == NodeCategory::SubTree;
  return elements_[node].tag == "Action" || is_modeled_action(type_of(node));
}

bool Circumstances::tree_may_run(std::uint32_t tree) {
  if (runs_[tree] == Runs::Unknown) {
    runs_[tree] = Runs::Never;  // for a tree that contains itself
    if (levels_ == kMostNested) return false;
    ++levels_;
    runs_[tree] = may_run(tree) ? Runs::Perhaps : Runs::Never;
    --levels_;
  }
  return runs_[tree] == Runs::Perhaps;
}

// Of this tree alone, since one line for a file is enough.
bool Circumstances::has_unknown_leaf(std::uint32_t element) const {
  return std::ranges::any_of(
      std::views::iota(element, elements_[element].end), [&](std::uint32_t node) {
        return node + 1 == elements_[node].end && !is_explicit_tag(elements_[node].tag) &&
               conversion_.from_nodes.find(type_of(node)) == nullptr &&
               !modeled_.contains(type_of(node));
      });
}

bool Circumstances::is_modeled_action(std::string_view type) const {
  return modeled_actions_.contains(type);
}

Circumstances::Skips Circumstances::skips(std::uint32_t element) {
  if (skips_[element] == Skips::Unknown) {
    skips_[element] = Skips::Nothing;  // for a tree that contains itself
    if (levels_ == kMostNested) return Skips::Nothing;
    ++levels_;
    skips_[element] = find_skips(element);
    --levels_;
  }
  return skips_[element];
}

// A script of it, or what skips all that it consists of.
Circumstances::Skips Circumstances::find_skips(std::uint32_t element) {
  if (has_script(element, Hook::SkipIf) || has_script(element, Hook::While)) return Skips::Script;
  if (const std::uint32_t tree = tree_of(element); tree != 0) {
    return tree + 1 < elements_[tree].end ? skips(tree + 1) : Skips::Nothing;
  }
  const std::string_view type = type_of(element);
  if (type == "KeepRunningUntilFailure" || type.starts_with("SubTree")) return Skips::Nothing;
  if (element + 1 == elements_[element].end) {
    const bool is_known = conversion_.from_nodes.find(type) != nullptr;
    return is_known ? Skips::Nothing : Skips::Leaf;
  }
  const bool is_branch =
      type == "IfThenElse" || type == "WhileDoElse" || type.starts_with("Switch");
  Skips any = Skips::Nothing, all = Skips::Script;
  for (const std::uint32_t child : children_in(elements_, element)) {
    any = std::max(any, skips(child));
    all = std::min(all, skips(child));
  }
  return is_branch ? any : all;
}

bool Circumstances::is_decided_by_script(std::uint32_t element) const {
  return has_script(element, Hook::SuccessIf) || has_script(element, Hook::FailureIf);
}

}  // namespace lockstep::host
