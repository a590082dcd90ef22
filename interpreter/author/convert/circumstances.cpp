#include "author/convert/circumstances.h"

#include <algorithm>
#include <ranges>

#include "base/core/pre_order.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

constexpr int kMostSubtrees = 64;  // one in the other

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
      is_held_(elements_.size()) {
  find_held();
}

bool Circumstances::apply(btcpp::When when, std::uint32_t element) const {
  const std::uint32_t first = element + 1;
  const bool has_child = first < elements_[element].end;
  switch (when) {
    case btcpp::When::Always:
      return true;
    case btcpp::When::IsHeld:
      return is_held_[element];
    case btcpp::When::ConditionRuns:
      return has_child && may_run(first);
    case btcpp::When::FirstIsSkipped:
      return has_child && may_be_skipped(first, kMostSubtrees);
    case btcpp::When::FirstIsDecided:
      return has_child && is_decided_by_script(first);
  }
  return true;
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
  for (const std::uint32_t tree : children_in(elements_, 0)) {
    const Attribute* name = document_.find_attribute(tree, "ID");
    if (elements_[tree].tag == "BehaviorTree" && name != nullptr && name->value == id->value) {
      return tree;
    }
  }
  return 0;
}

bool Circumstances::has_script(std::uint32_t element, Hook hook) const {
  const auto is_it = [&](const Attribute& it) {
    return hook_named(it.name, conversion_.from) == hook;
  };
  return std::ranges::any_of(document_.attributes(element), is_it);
}

void Circumstances::find_held() {
  const auto hold = [&](std::uint32_t element) {
    for (std::uint32_t it = element + 1; it < elements_[element].end; ++it) is_held_[it] = true;
  };
  std::vector<std::uint32_t> subtrees;  // whose trees are to be looked at
  for (std::uint32_t element = 0; element < elements_.size(); ++element) {
    if (!is_held_[element] && is_synchronized(type_of(element))) hold(element);
  }
  for (bool changes = true; changes;) {
    changes = false;
    for (std::uint32_t element = 0; element < elements_.size(); ++element) {
      const std::uint32_t tree = is_held_[element] ? tree_of(element) : 0;
      if (tree == 0 || tree + 1 >= elements_[tree].end || is_held_[tree + 1]) continue;
      hold(tree);
      changes = true;
    }
  }
}

// Whether something in it may run for several ticks.
bool Circumstances::may_run(std::uint32_t element) const {
  return std::ranges::any_of(std::views::iota(element, elements_[element].end), [&](auto node) {
    const NodeType* known = conversion_.from_nodes.find(type_of(node));
    if (known != nullptr) return known->can_run;
    return elements_[node].tag == "Action" || is_modeled_action(type_of(node));
  });
}

bool Circumstances::is_modeled_action(std::string_view type) const {
  for (const std::uint32_t part : children_in(elements_, 0)) {
    if (elements_[part].tag != "TreeNodesModel") continue;
    for (const std::uint32_t model : children_in(elements_, part)) {
      const Attribute* id = document_.find_attribute(model, "ID");
      if (id != nullptr && id->value == type && elements_[model].tag == "Action") return true;
    }
  }
  return false;
}

// By a script of it, or of all that it consists of.
bool Circumstances::may_be_skipped(std::uint32_t element, int most_subtrees) const {
  if (has_script(element, Hook::SkipIf) || has_script(element, Hook::While)) return true;
  const auto skips = [&](std::uint32_t it) { return may_be_skipped(it, most_subtrees); };
  if (const std::uint32_t tree = tree_of(element); tree != 0) {
    const bool has_root = tree + 1 < elements_[tree].end;
    return most_subtrees > 0 && has_root && may_be_skipped(tree + 1, most_subtrees - 1);
  }
  const std::string_view type = type_of(element);
  const bool is_branch =
      type == "IfThenElse" || type == "WhileDoElse" || type.starts_with("Switch");
  bool any = false, all = true;
  for (const std::uint32_t child : children_in(elements_, element)) {
    const bool is_skipped = skips(child);
    any |= is_skipped;
    all &= is_skipped;
  }
  return any && (all || is_branch) && type != "KeepRunningUntilFailure";
}

bool Circumstances::is_decided_by_script(std::uint32_t element) const {
  return has_script(element, Hook::SuccessIf) || has_script(element, Hook::FailureIf);
}

}  // namespace lockstep::host
