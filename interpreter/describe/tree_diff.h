// What has changed between two trees, by what they mean: after includes and arguments, whatever
// their texts look like. For `lockstep diff`; prints nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "describe/tree_matching.h"
#include "tree/definition.h"

namespace lockstep::host {

struct TreeSide {
  std::string name;  // of its file
  const Definition* definition;
  std::function<SourceLocation(Place)> locate;
};

struct ValueChange {
  std::string name, old_value, new_value;  // "": it is absent
};

std::vector<ValueChange> compare_values(const Definition& a, const DefinitionNode& of_a,
                                        const Definition& b, const DefinitionNode& of_b);

enum class TreeChangeKind : std::uint8_t { Changed, Renamed, Moved, New, Gone };
std::string_view to_string(TreeChangeKind kind);

struct TreeChange {
  TreeChangeKind kind;
  std::uint32_t old_node = kNoNode, new_node = kNoNode;
  SourceLocation old_place = {}, new_place = {};
  std::vector<ValueChange> values = {};  // of Changed; the kind of the node is called ""
  std::uint32_t below = 0;               // of New and Gone: how many nodes are so with it
  std::uint32_t around = kNoNode;        // of New and Gone: the first old node in it that stays
  std::uint32_t old_child = 0, new_child = 0;  // of Moved below the same node: the places, from 1
  std::vector<std::string> also = {};  // the paths of other nodes with the same change: one text,
                                       // a tree that several SubTrees use, is there several times
};

struct PropertyChange {
  std::string name, old_text, new_text;  // "": it is absent
  SourceLocation old_place = {}, new_place = {};
};

class TreeDiff {
 public:
  TreeDiff(TreeSide old_side, TreeSide new_side);

  bool same() const { return changes.empty() && properties.empty() && !is_tree_renamed(); }
  // The ID of the tree, which is the first part of all paths.
  bool is_tree_renamed() const { return sides[0].definition->id != sides[1].definition->id; }
  const std::string& path(const TreeChange& change) const {
    return change.new_node != kNoNode ? trees[1].paths[change.new_node]
                                      : trees[0].paths[change.old_node];
  }

  const TreeSide sides[2];
  const MatchedTree trees[2];
  Matching matching;
  std::vector<TreeChange> changes;  // in the order of the new tree
  std::vector<PropertyChange> properties;
  std::vector<bool> is_changed, is_moved;  // by new node; also where it is one of `also`

 private:
  class Finder;
};

// A line for each change; nothing if there is none.
std::string diff_as_text(const TreeDiff& diff, bool color);
// Both trees in one: each line with its sign, and what has not changed in short.
std::string diff_as_tree(const TreeDiff& diff, bool ascii, bool color);
std::string diff_as_json(const TreeDiff& diff);
std::string diff_as_svg(const TreeDiff& diff);
// A page in HTML with the drawing and the lines.
std::string diff_as_page(const TreeDiff& diff);
// A whole tree of a file that is new or gone: a line as text or JSON.
std::string tree_as_change(const std::string& id, TreeChangeKind kind, const std::string& file,
                           bool as_json);

// Shared by the functions above.

struct DiffRow {
  std::uint32_t depth = 0;
  char sign = ' ';  // + new, - gone, ~ changed or renamed, > moved to here, < moved from here
  std::uint32_t old_node = kNoNode, new_node = kNoNode;
  std::uint32_t hidden = 0;       // so many nodes below it have not changed
  std::uint32_t alike = kNoNode;  // this new node has the same changes below it: the tree is used
                                  // several times
  bool is_last = false;           // of its siblings
};
std::vector<DiffRow> rows_of(const TreeDiff& diff);
// "Wait 'arm' seconds="1" → "2"".
std::string text_of(const TreeDiff& diff, const DiffRow& row);
// "msec 500 → 800".
std::string text_of(const std::vector<ValueChange>& values);
std::string text_of_node(const Definition& definition, const DefinitionNode& node);

}  // namespace lockstep::host
