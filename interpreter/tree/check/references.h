// How the trees of a project refer to each other by SubTree.
#pragma once

#include <string_view>
#include <vector>

#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Reports references to unknown trees, trees that contain themselves (with the chain), and trees
// that are larger or deeper than kMaxNodes or kMaxDepth once expanded, or whose paths are too long.
// False when a tree contains itself or exceeds a limit: it cannot be expanded then. `elsewhere`:
// trees of other files, which may be meant.
bool check_references(const CheckedTrees& trees, const Reporter& report,
                      std::vector<std::string_view> elsewhere = {});

// The ID of a tree as its file has it, without that of Project::prefixes.
inline std::string_view id_in(std::string_view space, std::string_view id) {
  return id.starts_with(space) ? id.substr(space.size()) : id;
}
// Those of the trees that the file can name.
template <class Ids>
std::vector<std::string_view> ids_in(std::string_view space, const Ids& ids) {
  std::vector<std::string_view> own;
  for (const std::string_view it : ids)
    if (it.starts_with(space)) own.push_back(id_in(space, it));
  return own;
}

}  // namespace lockstep::host
