// A language in which trees are written: what it says otherwise than another one, as data. The
// rest of lockstep asks these rules, never which language it is.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/core/hook.h"

namespace lockstep::host {

struct NodeKind;        // engine/node_kind.h
struct LanguageReader;  // tree/language_reader.h

struct LanguageRules {
  std::string_view name;            // as `convert --to` has it
  std::string_view title;           // in messages, after "is for" or "in"
  std::string_view root_attribute;  // by which the root of a file says that it is in this language
  bool root_may_lack_it;            // so a root that says nothing is in it, too
  std::array<std::string_view, kHooks> hooks;  // the attributes of these scripts
  std::string_view on_resume, commit;          // attributes of actions: LeafAtCut
  std::span<const NodeKind* const> kinds;      // built in, in the order of their documentation
  const LanguageReader* reader;

  // Documents.
  bool lenient_xml;       // what programs write that is not quite XML is no error
  bool lenient_includes;  // an <include> may name a package, and have attributes without a meaning
  bool unknown_arguments_are_text;  // ${name} stays where no such <arg> is declared
  bool may_lack_nodes;              // what no plugin has can be noted instead of refused
  bool checks_unused_trees;         // as if each of them were the main tree

  // Entries and scripts.
  bool strict_types;    // each entry has one type, which a port or a script declares
  bool marked_keys;     // "@key" is of the main tree, and "_key" is passed on by a remapping only
  bool strict_scripts;  // 'and' and 'or' are signs, and a doubtful assignment is an error

  // Ticks.
  bool conditions_may_run;  // a condition of a plugin may return Running
  bool may_tick_again;      // a node may be ticked twice in a tick, and ask for another tick
};

// lockstep's own language.
extern const LanguageRules kLockstepRules;
// All languages, the own one first: the list is in dialect/languages.cpp.
std::span<const LanguageRules* const> languages();

// The attribute that has the script.
constexpr std::string_view attribute_of(Hook hook, const LanguageRules& rules) {
  return rules.hooks[static_cast<std::size_t>(hook)];
}

constexpr std::optional<Hook> hook_named(std::string_view attribute, const LanguageRules& rules) {
  for (std::size_t hook = 0; hook < kHooks; ++hook) {
    if (rules.hooks[hook] == attribute) return static_cast<Hook>(hook);
  }
  return std::nullopt;
}

constexpr bool is_of_actions(std::string_view attribute, const LanguageRules& rules) {
  return attribute == rules.on_resume || attribute == rules.commit;
}

// The version of what trees mean: docs/nodes-and-attributes.md lists them. Recordings name it.
inline constexpr std::uint64_t kLawVersion = 3;

}  // namespace lockstep::host
