#include "author/edit/subtree_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "author/edit/edits.h"
#include "author/edit/element_text.h"
#include "author/edit/entry_uses.h"
#include "author/edit/line_shift.h"
#include "author/edit/slot.h"
#include "author/edit/unknown_uses.h"
#include "base/core/wording.h"
#include "language/document/value_text.h"

namespace lockstep::host {
namespace {

using Way = EntryUse::Way;

constexpr std::string_view kMainTree = "main_tree_to_execute";

// Whether a SubTree below the node has a tree that an argument chooses, and passes on all entries.
bool passes_on_by_choice(const ProjectTexts& texts, ElementAt node) {
  const std::uint32_t end = texts.document(node.document).elements()[node.element].end;
  for (ElementAt at = node; at.element < end; ++at.element) {
    const bool is_choice = texts.value(at, "ID").find("${") != std::string_view::npos;
    if (texts.is_sub_tree(at) && is_choice && passes_on_all(texts, at)) return true;
  }
  return false;
}

// The first script around ticks that an element has.
const Attribute* hook_of(const ProjectTexts& texts, ElementAt at) {
  for (const Attribute& it : texts.document(at.document).attributes(at.element))
    if (hook_named(it.name, texts.rules())) return &it;
  return nullptr;
}

// The part of a text that the edit leaves there.
std::string edited_part(std::string_view text, std::size_t begin, std::size_t end,
                        const TextEdit& edit) {
  TextEdit own;
  for (Patch& it : edit.patches()) {
    if (it.begin >= begin && it.end <= end)
      own.replace(it.begin - begin, it.end - begin, std::move(it.text));
  }
  return own.apply(text.substr(begin, end - begin));
}

class Inliner {
 public:
  Inliner(const ProjectTexts& texts, ElementAt sub_tree, ElementAt outer, ElementAt inner)
      : texts_(texts),
        sub_tree_(sub_tree),
        outer_(outer),
        root_{inner.document, inner.element + 1},
        document_(texts.document(root_.document)),
        uses_(entry_uses(texts, root_)),
        outer_keys_(keys_in(texts, outer)) {}

  Result<ProjectEdit> run() {
    for (const EntryUse& use : uses_) {
      if (auto wrong = move(use)) return tl::unexpected(std::move(*wrong));
    }
    const auto attributes = texts_.document(sub_tree_.document).attributes(sub_tree_.element);
    for (const Attribute& it : attributes) {
      if (auto wrong = keep(it)) return tl::unexpected(std::move(*wrong));
    }
    return replace();
  }

 private:
  std::optional<Problem> move(const EntryUse& use) {
    const auto bound = binding_of(texts_, sub_tree_, use.key);
    if (use.key.starts_with('@')) return std::nullopt;
    if (!bound || !is_remapping(texts_, use.key)) return move_unbound(use);
    if (*bound == "{=}") return std::nullopt;
    if (const auto key = key_in_braces(*bound)) {
      rename_use(edit_, texts_, use, *key);
      return std::nullopt;
    }
    const Parameter* const port = use.parameter;
    const bool is_read = use.way == Way::Port && port != nullptr && !port->is_key &&
                         !port->names_entry && port->direction == Direction::Input;
    if (!is_read) {
      return Problem{fmt::format("the entry '{}' has a start value here", brief(use.key)),
                     "write it with a Script before the SubTree, and bind the entry"};
    }
    replace_in_value(edit_, document_, *use.attribute, 0, use.attribute->value.size(), *bound);
    return std::nullopt;
  }

  std::optional<Problem> move_unbound(const EntryUse& use) {
    const bool is_own = texts_.rules().marked_keys && use.key.starts_with('_');
    if (passes_on_all(texts_, sub_tree_) && !is_own) return std::nullopt;
    if (is_outer_passed_on()) {
      return Problem{fmt::format("the entry '{}' is one of each use of the tree", brief(use.key)),
                     "the tree around it shares all its entries: bind it in the SubTree"};
    }
    const std::string& name = own_names_.try_emplace(use.key, free_name(use.key)).first->second;
    if (name != use.key) rename_use(edit_, texts_, use, name);
    return std::nullopt;
  }

  bool is_outer_passed_on() const {
    bool is_passed_on = false;
    texts_.for_each_element([&](ElementAt at) {
      const bool is_use =
          texts_.is_sub_tree(at) && texts_.value(at, "ID") == texts_.value(outer_, "ID");
      is_passed_on |= is_use && passes_on_all(texts_, at);
    });
    return is_passed_on;
  }

  std::string free_name(const std::string& key) const {
    const auto is_taken = [&](const std::string& name) {
      const bool is_own =
          std::ranges::any_of(own_names_, [&](const auto& it) { return it.second == name; });
      const bool is_inner = name != key && std::ranges::count(uses_, name, &EntryUse::key) != 0;
      return is_own || is_inner || outer_keys_.contains(name);
    };
    std::string name = key;
    for (int number = 2; is_taken(name); ++number) name = fmt::format("{}_{}", key, number);
    return name;
  }

  // The first node gets what the SubTree says beside its entries.
  std::optional<Problem> keep(const Attribute& attribute) {
    const std::string_view name = attribute.name;
    const bool is_hook = hook_named(name, texts_.rules()).has_value();
    const bool is_used = std::ranges::count(uses_, name, &EntryUse::key) != 0;
    if (!is_hook && name != "name" && name != "_description") {
      if (!is_remapping(texts_, name) || is_used) return std::nullopt;
      return Problem{fmt::format("'{}' is not an entry of the tree", brief(name)),
                     "remove it, or rename the barrier in the tree"};
    }
    // One node runs its scripts otherwise than two do, one around the other.
    const Attribute* const other = hook_of(texts_, root_);
    if (is_hook && other != nullptr) {
      return Problem{
          fmt::format("the SubTree has '{}', and the first node has '{}'", name, other->name),
          "put the SubTree into a node, and move the script there"};
    }
    if (document_.find_attribute(root_.element, name) != nullptr) return std::nullopt;
    auto added = set_attribute(document_, root_.element, name, attribute.value);
    if (!added) return added.error();
    edit_.add(std::move(*added));
    return std::nullopt;
  }

  Result<ProjectEdit> replace() {
    const Document& around = texts_.document(sub_tree_.document);
    const auto from = element_text(document_, root_.element);
    const auto to = element_text(around, sub_tree_.element);
    if (!from || !to) return problem("the text is broken at this place");
    const std::string_view text = document_.source()->text(), outer = around.source()->text();
    const std::string xml = edited_part(text, from->tag.begin, from->end, edit_);
    const auto before = indentation(text, from->tag.begin),
               after = indentation(outer, to->tag.begin);
    const Grammar grammar = grammar_of(document_);
    ProjectEdit edit(texts_.size());
    edit[sub_tree_.document].replace(
        to->tag.begin, to->end,
        shifted(with_line_ends(xml, grammar, line_end_of(outer)), grammar, before.value_or(""),
                before && after ? *after : before.value_or("")));
    return edit;
  }

  const ProjectTexts& texts_;
  ElementAt sub_tree_, outer_, root_;
  const Document& document_;  // of the tree
  std::vector<EntryUse> uses_;
  std::set<std::string> outer_keys_;
  std::map<std::string, std::string> own_names_;
  TextEdit edit_;
};

// The SubTree in the place of a node.
Result<std::string> sub_tree_for(const ProjectTexts& texts, ElementAt node, std::string_view id) {
  std::string sub_tree = fmt::format("<SubTree ID={}", quoted(id));
  for (const std::string& key : keys_in(texts, node)) {
    if (key.starts_with('@')) continue;
    if (!is_remapping(texts, key)) {
      return problem(fmt::format("the entry '{}' cannot be passed on to a tree", brief(key)),
                     "it is called as an attribute of every node: rename it");
    }
    sub_tree += fmt::format(" {}=\"{{{}}}\"", key, key);
  }
  return sub_tree + "/>";
}

// Whether a property or an expectation names the node, whose name goes with it.
bool is_named_beside(const ProjectTexts& texts, std::string_view name) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const auto is_letter = [&](std::string_view text, std::size_t at) {
    return at < text.size() && kLetters.find(text[at]) != std::string_view::npos;
  };
  bool is_named = false;
  texts.for_each_element([&](ElementAt at) {
    const std::string_view tag = texts.document(at.document).elements()[at.element].tag;
    if (tag != "property" && tag != "expect") return;
    const std::string_view text = texts.value(at, "");
    for (auto i = text.find(name); i != std::string_view::npos; i = text.find(name, i + 1))
      is_named |= !is_letter(text, i - 1) && !is_letter(text, i + name.size());
  });
  return is_named;
}

}  // namespace

Result<ProjectEdit> extract_subtree(const ProjectTexts& texts, ElementAt node,
                                    std::string_view id) {
  const auto tree = texts.tree_around(node);
  if (!tree) return problem("only a node of a tree can become a tree");
  const Document& document = texts.document(node.document);
  if (auto wrong = names_at_run_time(texts)) return tl::unexpected(std::move(*wrong));
  if (auto wrong = unknown_uses(texts, node)) return tl::unexpected(std::move(*wrong));
  if (passes_on_by_choice(texts, node)) {
    return problem("a SubTree in it may pass on all entries to one of several trees",
                   "an argument chooses which: name the entries there");
  }
  auto sub_tree = sub_tree_for(texts, node, id);
  if (!sub_tree) return tl::unexpected(std::move(sub_tree.error()));
  const auto at = element_text(document, node.element);
  if (!at) return problem("the text is broken at this place");
  const std::string_view text = document.source()->text();
  const std::string unit = indentation_unit(document);
  const std::string xml =
      shifted(text.substr(at->tag.begin, at->end - at->tag.begin), grammar_of(document),
              indentation(text, at->tag.begin).value_or(""), unit);
  auto added = insert_behind(
      document, tree->element,
      fmt::format("<BehaviorTree ID={}>\n{}{}\n</BehaviorTree>", quoted(id), unit, xml));
  if (!added) return tl::unexpected(std::move(added.error()));
  ProjectEdit edit(texts.size());
  edit[node.document] = std::move(*added);
  edit[node.document].replace(at->tag.begin, at->end, std::move(*sub_tree));
  // The only tree of a file is no longer the only one.
  if (texts.value({0, 0}, kMainTree).empty() && !texts.main_tree().empty()) {
    if (auto named = set_attribute(texts.document(0), 0, kMainTree, texts.main_tree()))
      edit[0].add(std::move(*named));
  }
  return edit;
}

Result<ProjectEdit> inline_subtree(const ProjectTexts& texts, ElementAt sub_tree) {
  if (!texts.is_sub_tree(sub_tree)) return problem("only a SubTree can become nodes");
  const auto outer = texts.tree_around(sub_tree);
  const std::string_view id = texts.value(sub_tree, "ID");
  const auto inner = texts.find_tree(id);
  if (!outer || !inner) return problem(fmt::format("there is no tree '{}'", brief(id)));
  if (texts.prefix(inner->document) != texts.prefix(sub_tree.document)) {
    return problem(fmt::format("the tree '{}' is in a file that is included with 'as'", brief(id)),
                   "what it calls by name is called otherwise here");
  }
  const Element& tree = texts.document(inner->document).elements()[inner->element];
  if (tree.end == inner->element + 1) {
    return problem(fmt::format("the tree '{}' has no node", brief(id)));
  }
  const std::string_view name = texts.value(sub_tree, "name");
  if (is_named_beside(texts, name.empty() ? id : name)) {
    return problem(fmt::format("a property names '{}'", brief(name.empty() ? id : name)),
                   "let it name a node inside of it first");
  }
  if (auto wrong = names_at_run_time(texts)) return tl::unexpected(std::move(*wrong));
  if (auto wrong = unknown_uses(texts, *inner)) return tl::unexpected(std::move(*wrong));
  return Inliner(texts, sub_tree, *outer, *inner).run();
}

}  // namespace lockstep::host
