// The blackboard while subtrees are expanded: which entry a {key} means in which SubTree.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "base/blackboard/board.h"
#include "base/core/language.h"
#include "tree/definition.h"

namespace lockstep::host {

class Scope {
 public:
  static constexpr std::uint32_t kNone = Port::kNone;

  // The groups that are declared, by their names in the project.
  using Groups = std::map<std::string_view, std::size_t>;

  // The scope of the main tree. With a board outside, "@key" is not its "key". `space` is that of
  // the tree.
  Scope(std::vector<BlackboardEntry>& entries, const LanguageRules& rules, bool has_outside,
        const Groups& groups, std::string_view space)
      : entries_(entries),
        rules_(rules),
        declared_(groups),
        space_(space),
        has_outside_(has_outside) {}
  // The scope of a SubTree inside `outer`.
  Scope(Scope& outer, std::string_view name, bool autoremap, std::string_view space)
      : entries_(outer.entries_),
        rules_(outer.rules_),
        declared_(outer.declared_),
        space_(space),
        outer_(&outer),
        path_((outer.path_.empty() ? "" : outer.path_ + "/").append(name)),
        autoremap_(autoremap) {}

  // The SubTree attribute inner="{outer_key}".
  void remap(std::string_view inner, std::string_view outer_key) { remapped_[inner] = outer_key; }
  // The SubTree attribute inner="text": a start value.
  void set_text(std::string_view inner, std::string_view text) { texts_[inner] = text; }

  struct Found {
    std::uint32_t entry;
    bool is_new;            // not used before, so it has no type yet
    std::string_view text;  // its start value as written, or ""
    bool has_text;
  };
  // The entry that `key` means here; created if it does not exist.
  Found find(std::string_view key);
  // Whether that entry belongs to this tree, not to an outer one.
  bool is_own(std::string_view key) const {
    return !key.starts_with('@') && (outer_ == nullptr || texts_.contains(key) ||
                                     (!remapped_.contains(key) && !passes_on(key)));
  }
  // For names that are known only at run time: what names mean here. Not its place among boards.
  Board board() const;
  // The name in the project of the group that `name` means here: what an attribute of a SubTree
  // says, else that of its file, else that of the file outside.
  std::string_view group(std::string_view name);
  // The same of a name that may be something else; "" if it means itself.
  std::string_view renamed_group(std::string_view name);
  bool used(std::string_view key) const { return known_.contains(key) || groups_.contains(key); }
  // The keys and names that are used but that no attribute of the SubTree sets.
  std::vector<std::string_view> open_keys() const;

 private:
  // Whether a key that is neither remapped nor has a start value is one outside.
  bool passes_on(std::string_view key) const;
  std::string_view meaning_of_group(std::string_view name, bool uses_it);
  // The group of that name that this file, or one that includes it by a name, declares; "" if the
  // scope outside knows better.
  std::string_view group_of_file(std::string_view name) const;
  Scope& main() { return outer_ == nullptr ? *this : outer_->main(); }
  // "grasp/force", or "grasp#2/force" if a SubTree of that name elsewhere has that.
  std::string unique_name(std::string_view key);

  std::vector<BlackboardEntry>& entries_;
  const LanguageRules& rules_;
  const Groups& declared_;
  std::string_view space_;
  Scope* outer_ = nullptr;
  std::string path_;  // the names of the SubTrees around: "grasp/hand"
  bool autoremap_ = false;
  bool has_outside_ = false;
  std::map<std::string_view, std::string_view> remapped_;
  std::map<std::string_view, std::string_view> texts_;
  std::map<std::string_view, std::uint32_t> known_;
  std::set<std::string, std::less<>> groups_;  // names of groups that were looked up
  unsigned number_ = 1;                        // of those with the same path
  // Of the main tree: the names of all entries.
  std::unordered_set<std::string> names_;
};

}  // namespace lockstep::host
