#include "cli/load/real_time_leaves.h"

#include <fmt/format.h>

namespace lockstep::host {

bool warn_of_real_time_leaves(const Tree& tree, const std::string& file, const std::string& hint,
                              Diagnostics& diagnostics) {
  constexpr std::size_t kMostNamed = 5;
  std::string names;
  std::size_t count = 0;
  for (const LeafNode& leaf : tree.leaves) {
    if (!leaf.type->real_time || ++count > kMostNamed) continue;
    names += fmt::format("{}'{}' ({} of plugin '{}')", names.empty() ? "" : ", ",
                         tree.path(leaf.node), leaf.type->id, leaf.type->plugin);
  }
  if (count == 0) return false;
  if (count > kMostNamed) names += fmt::format(" and {} more", count - kMostNamed);
  diagnostics.warning(
      "real-time-leaf"_code, {file},
      "on the virtual clock no tick waits for leaves that work in real time: " + names, hint);
  return true;
}

}  // namespace lockstep::host
