// Where a part of a tree names entries of the blackboard: in ports, in scripts, in what SubTrees
// pass on.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "author/edit/project_texts.h"

namespace lockstep::host {

struct EntryUse {
  enum class Way : unsigned char {
    Port,      // "{k}", or "k" where a port takes a name
    SameName,  // k="{=}": the value is '{=}'
    Script,
    Default,    // a port that is left out, and bound to it by a model; there is no attribute
    Automatic,  // a SubTree that passes on all; there is no attribute
  };
  Way way;
  ElementAt at;
  std::string key;
  const Attribute* attribute = nullptr;
  std::size_t begin = 0, end = 0;  // in its value
  const Parameter* parameter = nullptr;
  std::string port = {};  // of a Default
};

// In the elements of `part` and below it, in the order of the text.
std::vector<EntryUse> entry_uses(const ProjectTexts& texts, ElementAt part);
std::set<std::string> keys_in(const ProjectTexts& texts, ElementAt part);

// Whether the name means something else than an entry in scripts.
bool is_word_of_scripts(std::string_view name, const LanguageRules& rules, const Catalog& catalog);

// Why entries of the project cannot change: a script, or the name of an entry, is in an entry.
std::optional<Problem> names_at_run_time(const ProjectTexts& texts);

// Whether a SubTree passes on entries without an attribute.
bool passes_on_all(const ProjectTexts& texts, ElementAt sub_tree);
// The value to which a SubTree binds a key of its tree: its attribute, or the default of a model.
// Nothing if neither is there.
std::optional<std::string_view> binding_of(const ProjectTexts& texts, ElementAt sub_tree,
                                           std::string_view key);
// Whether the language gives this attribute of a SubTree a meaning.
bool is_of_sub_trees(const ProjectTexts& texts, std::string_view attribute);
// Whether an attribute of a SubTree binds a key, and is not of the language.
bool is_remapping(const ProjectTexts& texts, std::string_view attribute);

// Makes `use` one of `new_key`.
void rename_use(TextEdit& edit, const ProjectTexts& texts, const EntryUse& use,
                std::string_view new_key);

}  // namespace lockstep::host
