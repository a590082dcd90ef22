// A project before subtrees are expanded: each node of each BehaviorTree with its type, its
// parameters as values, and the places that messages may name. Later stages read only this, not the
// documents.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/core/hook.h"
#include "base/core/language.h"
#include "base/core/node_type.h"
#include "base/core/place.h"
#include "tree/definition.h"

namespace lockstep::host {

// A parameter of a node: a constant, a {key} with its default, or absent.
struct CheckedPort {
  std::uint32_t value = Port::kNone;  // in CheckedTrees::values; of a script, in scripts
  Place place = {};                   // of the attribute that has the key, or names a group
  std::string_view key = {};

  // The key was written as a text, and makes no entry.
  bool is_name(const Parameter& parameter) const {
    const bool takes_names = parameter.is_key || parameter.names_entry;
    return takes_names && value != Port::kNone && !key.empty();
  }
};

// A script of a node or, without a hook, of a port.
struct CheckedScript {
  Hook hook;
  Place place;           // of its attribute
  bool is_last = false;  // of its node
  std::shared_ptr<const Expression> code;
};

struct CheckedNode {
  const NodeType* type = nullptr;  // null after an error
  std::string_view name;
  Place place;
  std::uint32_t end = 0;  // in CheckedTrees::nodes
  std::uint32_t children = 0;
  std::uint32_t first = 0;              // in CheckedTrees::ports; of a SubTree, in subtrees
  std::uint32_t written = Port::kNone;  // its first in CheckedTrees::written
  std::uint32_t scripts = Port::kNone;  // its first in CheckedTrees::scripts
  LeafAtCut at_cut = {};
};

// A SubTree binds a key of its tree to this: an outer entry, or a start value.
struct Remapping {
  std::string_view key;
  std::string_view value;  // the key outside, or the text
  bool is_entry;
  Place place;
  bool is_written = true;  // in the SubTree; else a model says so
};

// A SubTree: the tree that it names, its remappings, and its place in the tree that contains it.
struct CheckedSubTree {
  std::uint32_t node;
  std::string_view id = {};  // "" after an error
  Place place = {};          // of the attribute that has it
  bool autoremap = false;
  std::uint32_t first = 0, remappings = 0;  // in CheckedTrees::remappings
  std::uint32_t depth = 0;                  // below the root
  std::uint64_t path_size = 0;              // bytes of its path, from the root on
};

// One BehaviorTree, its subtrees not expanded.
struct CheckedTree {
  std::uint32_t root;                             // in CheckedTrees::nodes
  std::uint32_t first_subtree = 0, subtrees = 0;  // in CheckedTrees::subtrees
  std::uint32_t depth = 0;                        // levels
  std::uint64_t paths_size = 0;  // bytes of the paths of all its nodes, from the root on
  std::string_view space = {};   // Project::prefixes of its file
};

// The main file.
struct CheckedMain {
  Place place;
  std::optional<std::string_view> tree = {};  // that it names to be run
  Place tree_place = {};                      // of the attribute that does
  bool is_only = false;                       // it names none, and has this one alone
};

struct CheckedTrees {
  const LanguageRules* rules = &kLockstepRules;
  std::shared_ptr<const ScriptEnums> words;  // that scripts know as numbers; null: none
  std::vector<CheckedNode> nodes;
  std::vector<Value> values;
  std::vector<CheckedPort> ports;
  std::vector<CheckedSubTree> subtrees;
  std::vector<Remapping> remappings;
  std::vector<WrittenAttribute> written;
  std::vector<CheckedScript> scripts;
  std::unordered_map<std::string_view, std::shared_ptr<const Expression>> compiled;  // by the text
  std::vector<std::uint32_t> shared = {};         // of expand(): by a first port, those made of it
  std::list<std::string> texts;                   // that are not as the documents have them
  std::map<std::string_view, CheckedTree> trees;  // by the ID of the BehaviorTree
  std::vector<std::string_view> ids;              // as they stand in the documents
  std::vector<WrittenProperty> properties;        // of the main file
  std::vector<CheckedNode> groups;                // declared beside the trees; names are distinct
  bool shares_entries = false;                    // Definition::shares_entries
  bool has_outside = false;                       // "@key" is of a board outside of the main tree
  bool names_at_run_time = false;                 // names of entries, or scripts, are in entries
  const NodeType* team_member = nullptr;          // what stands for another robot
  const NodeType* team_resources = nullptr;       // what asks robots for resources
  std::optional<CheckedMain> main;                // none: it is no tree file
};

}  // namespace lockstep::host
