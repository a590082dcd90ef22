#include "author/edit/renames.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "author/edit/edits.h"
#include "author/edit/entry_uses.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

std::string_view tag_of(const ProjectTexts& texts, ElementAt at) {
  return texts.document(at.document).elements()[at.element].tag;
}

// If the value of this attribute is `name`.
void replace_value(ProjectEdit& edit, const ProjectTexts& texts, ElementAt at,
                   std::string_view attribute, std::string_view name, std::string_view new_name) {
  const Document& document = texts.document(at.document);
  const Attribute* it = document.find_attribute(at.element, attribute);
  if (it == nullptr || it->value != name) return;
  replace_in_value(edit[at.document], document, *it, 0, name.size(), new_name);
}

// Each `text` in a value that is not behind `unless`.
void replace_all(TextEdit& edit, const Document& document, const Attribute& attribute,
                 std::string_view text, std::string_view new_text, char unless) {
  const std::string_view value = attribute.value;
  for (auto at = value.find(text); at != std::string_view::npos; at = value.find(text, at + 1)) {
    if (at > 0 && value[at - 1] == unless) continue;
    replace_in_value(edit, document, attribute, at, at + text.size(), new_text);
  }
}

std::optional<Problem> check_key(const ProjectTexts& texts, std::string_view key,
                                 std::string_view new_key) {
  const bool is_marked = texts.rules().marked_keys && new_key.starts_with('_');
  const auto refused = [&](std::string why) {
    return Problem{fmt::format("'{}' cannot be a key", brief(new_key)), std::move(why)};
  };
  if (!is_identifier(new_key)) return refused(fmt::format("a key is {}", kIdentifierRule));
  if (key == new_key) return std::nullopt;
  if (is_word_of_scripts(new_key, texts.rules(), texts.catalog())) {
    return refused("scripts have this word already");
  }
  if (is_of_sub_trees(texts, new_key)) {
    return refused("a SubTree has an attribute of this name, so it could not be passed on");
  }
  if (!is_marked && new_key.starts_with('_') && is_remapping(texts, key)) {
    return refused("a SubTree cannot bind a key that begins with '_'");
  }
  if (is_marked != key.starts_with('_') && texts.rules().marked_keys) {
    return Problem{fmt::format("'{}' would be passed on to other trees otherwise", brief(new_key)),
                   "there, a key with '_' in front is passed on by an attribute only"};
  }
  return std::nullopt;
}

void rename_uses(ProjectEdit& edit, const ProjectTexts& texts, ElementAt tree, std::string_view key,
                 std::string_view new_key) {
  for (const EntryUse& use : entry_uses(texts, tree))
    if (use.key == key) rename_use(edit[use.at.document], texts, use, new_key);
}

// Renames the key in a SubTree of its tree.
void rename_remapping(ProjectEdit& edit, const ProjectTexts& texts, ElementAt sub_tree,
                      const std::string& key, std::string_view new_key) {
  const Document& document = texts.document(sub_tree.document);
  TextEdit& own = edit[sub_tree.document];
  if (const Attribute* it = document.find_attribute(sub_tree.element, key)) {
    if (!is_remapping(texts, key)) return;
    const bool is_same_name = it->value == "{=}";
    if (is_same_name) replace_in_value(own, document, *it, 0, 3, fmt::format("{{{}}}", key));
    if (auto renamed = rename_attribute(document, sub_tree.element, key, new_key))
      own.add(std::move(*renamed));
  } else if (passes_on_all(texts, sub_tree) && !binding_of(texts, sub_tree, key)) {
    const std::string value = fmt::format("{{{}}}", key);
    if (auto added = set_attribute(document, sub_tree.element, new_key, value))
      own.add(std::move(*added));
  }
}

// Properties and scenarios beside the trees are about the main tree.
void rename_beside(ProjectEdit& edit, const ProjectTexts& texts, ElementAt at, std::string_view key,
                   std::string_view new_key) {
  const std::string_view tag = tag_of(texts, at);
  if (tag == "set") replace_value(edit, texts, at, "key", key, new_key);
  if (tag != "property" && tag != "expect") return;
  const Document& document = texts.document(at.document);
  for (const Attribute& it : document.attributes(at.element)) {
    if (!it.name.empty()) continue;
    replace_all(edit[at.document], document, it, fmt::format("{{{}}}", key),
                fmt::format("{{{}}}", new_key), '$');
  }
}

auto made_by_argument(std::string_view name) {
  return problem(fmt::format("an argument has '{}' in it", brief(name)),
                 "write the name where it is used, in place of ${…}");
}

// Visits the attributes that name a tree.
void for_each_reference(const ProjectTexts& texts,
                        const std::function<void(ElementAt, std::string_view)>& visit) {
  texts.for_each_element([&](ElementAt at) {
    const std::string_view tag = tag_of(texts, at);
    if (tag == "BehaviorTree" || texts.is_sub_tree(at)) visit(at, "ID");
    if (at.element == 0) visit(at, "main_tree_to_execute");
    if (tag == "scenario" || tag == "scenarios") visit(at, "main");
  });
}

// As each tree calls an entry of the main tree.
std::string of_main_tree(std::string_view key) {
  return fmt::format("@{}", key);
}

// Whether a tree has the entry of the main tree by that name.
bool is_used_as_of_main_tree(const ProjectTexts& texts, std::string_view key) {
  bool is_used = false;
  texts.for_each_element([&](ElementAt at) {
    if (tag_of(texts, at) == "BehaviorTree")
      is_used |= keys_in(texts, at).contains(of_main_tree(key));
  });
  return is_used;
}

std::ptrdiff_t count_uses(const ProjectTexts& texts, ElementAt tree, std::string_view key) {
  return std::ranges::count(entry_uses(texts, tree), key, &EntryUse::key);
}

// Whether a SubTree of this tree binds the key, also where the tree does not use it.
bool is_bound(const ProjectTexts& texts, std::string_view tree, std::string_view key) {
  bool is_bound = false;
  texts.for_each_element([&](ElementAt at) {
    is_bound |= texts.is_sub_tree(at) && texts.tree_of(at) == tree && binding_of(texts, at, key);
  });
  return is_bound;
}

// Whether a SubTree whose tree an argument chooses passes the entry on, into the tree or out of it.
bool is_bound_by_choice(const ProjectTexts& texts, ElementAt tree, std::string_view key) {
  bool is_bound = false;
  texts.for_each_element([&](ElementAt at) {
    if (!texts.is_sub_tree(at) || texts.value(at, "ID").find("${") == std::string_view::npos)
      return;
    const auto around = texts.tree_around(at);
    const bool is_inside =
        around && around->document == tree.document && around->element == tree.element;
    const bool binds = texts.document(at.document).find_attribute(at.element, key) != nullptr;
    is_bound |= passes_on_all(texts, at) || (binds && !is_inside);
  });
  return is_bound;
}

}  // namespace

Result<ProjectEdit> rename_tree(const ProjectTexts& texts, std::string_view id,
                                std::string_view new_id) {
  const auto tree = texts.find_tree(id);
  if (!tree && texts.is_named_file(id)) {
    return problem(fmt::format("'{}' stands for the main tree of an included file", brief(id)),
                   "change 'as' of its include, and where that is used");
  }
  if (!tree) return problem(fmt::format("there is no tree '{}'", brief(id)));
  const std::string& prefix = texts.prefix(tree->document);
  if (!new_id.starts_with(prefix)) {
    return problem(fmt::format("'{}' is in a file that is included as '{}'", brief(id),
                               brief(prefix.substr(0, prefix.size() - 1))),
                   fmt::format("its new name must begin with '{}'", brief(prefix)));
  }
  const std::string_view old_name = id.substr(prefix.size());
  const std::string_view new_name = new_id.substr(prefix.size());
  if (new_name.empty() ||
      new_name.find_first_of(prefix.empty() ? "/{}$" : "/{}$.") != std::string_view::npos) {
    return problem(fmt::format("'{}' cannot be the ID of a tree", brief(new_id)),
                   "it has at least one character, and none of / { } $");
  }
  if (new_id != id && texts.find_tree(new_id)) {
    return problem(fmt::format("there is a tree '{}' already", brief(new_id)));
  }
  if (new_id != id && texts.catalog().find(new_id) != nullptr) {
    return problem(fmt::format("'{}' cannot be the ID of a tree", brief(new_id)),
                   "there is a node of this name");
  }
  ProjectEdit edit(texts.size());
  bool is_made = false;
  const ProjectTexts read = texts.with_arguments();
  for_each_reference(texts, [&](ElementAt at, std::string_view attribute) {
    for (const std::uint32_t copy : texts.copies(tree->document)) {
      const std::string& around = texts.prefix(at.document);
      const std::string& own = texts.prefix(copy);
      if (!own.starts_with(around)) continue;
      const std::string inner = own.substr(around.size());
      const std::string name = inner + std::string(old_name);
      // What was read has the prefixes in its values.
      is_made |= Project::written(read.value(at, attribute), around) == name &&
                 texts.value(at, attribute) != name;
      replace_value(edit, texts, at, attribute, name, inner + std::string(new_name));
    }
  });
  if (is_made) return made_by_argument(id);
  return edit;
}

Result<ProjectEdit> rename_entry(const ProjectTexts& texts, std::string_view tree,
                                 std::string_view key, std::string_view new_key) {
  const auto at_tree = texts.find_tree(tree);
  if (!at_tree) return problem(fmt::format("there is no tree '{}'", brief(tree)));
  if (auto wrong = check_key(texts, key, new_key)) return tl::unexpected(std::move(*wrong));
  if (auto wrong = names_at_run_time(texts)) return tl::unexpected(std::move(*wrong));
  ProjectEdit edit(texts.size());
  const bool is_main = texts.main_tree() == tree;
  const bool has_marks = is_main && texts.rules().marked_keys;
  const auto has = [&](std::string_view name) {
    return count_uses(texts, *at_tree, name) != 0 ||
           (has_marks && is_used_as_of_main_tree(texts, name));
  };
  if (!has(key)) {
    return problem(fmt::format("the tree '{}' has no entry '{}'", brief(tree), brief(key)));
  }
  if (count_uses(texts.with_arguments(), *at_tree, key) != count_uses(texts, *at_tree, key)) {
    return made_by_argument(key);
  }
  if (is_bound_by_choice(texts, *at_tree, key)) {
    return problem(fmt::format("a SubTree may pass on '{}' to one of several trees", brief(key)),
                   "an argument chooses which: rename it there by hand");
  }
  if (key == new_key) return edit;
  if (has(new_key)) {
    return problem(
        fmt::format("the tree '{}' has an entry '{}' already", brief(tree), brief(new_key)),
        "the two would become one");
  }
  if (is_bound(texts, tree, new_key)) {
    return problem(
        fmt::format("a SubTree of '{}' has an attribute '{}' already", brief(tree), brief(new_key)),
        "the entry would have its value");
  }
  rename_uses(edit, texts, *at_tree, key, new_key);
  for (const ElementAt port : texts.modeled_ports(tree))
    replace_value(edit, texts, port, "name", key, new_key);
  texts.for_each_element([&](ElementAt at) {
    if (texts.is_sub_tree(at) && texts.tree_of(at) == tree && texts.tree_around(at))
      rename_remapping(edit, texts, at, std::string(key), new_key);
    if (is_main) rename_beside(edit, texts, at, key, new_key);
    if (has_marks && tag_of(texts, at) == "BehaviorTree") {
      rename_uses(edit, texts, at, of_main_tree(key), of_main_tree(new_key));
    }
  });
  return edit;
}

Result<ProjectEdit> rename_argument(const ProjectTexts& texts, std::string_view name,
                                    std::string_view new_name) {
  if (!is_identifier(new_name)) {
    return problem(fmt::format("'{}' cannot be the name of an argument", brief(new_name)),
                   fmt::format("it is {}", kIdentifierRule));
  }
  bool is_declared = false, is_taken = false;
  texts.for_each_element([&](ElementAt at) {
    if (tag_of(texts, at) != "arg" || texts.is_in(at, "scenario")) return;
    is_declared |= texts.value(at, "name") == name;
    is_taken |= texts.value(at, "name") == new_name;
  });
  if (!is_declared) return problem(fmt::format("there is no argument '{}'", brief(name)));
  if (is_taken && name != new_name) {
    return problem(fmt::format("there is an argument '{}' already", brief(new_name)));
  }
  ProjectEdit edit(texts.size());
  texts.for_each_element([&](ElementAt at) {
    if (tag_of(texts, at) == "arg") replace_value(edit, texts, at, "name", name, new_name);
    if (texts.is_in(at, "scenario")) return;  // where it is a value of a row
    const Document& document = texts.document(at.document);
    for (const Attribute& it : document.attributes(at.element)) {
      replace_all(edit[at.document], document, it, fmt::format("${{{}}}", name),
                  fmt::format("${{{}}}", new_name), '$');
    }
  });
  return edit;
}

}  // namespace lockstep::host
