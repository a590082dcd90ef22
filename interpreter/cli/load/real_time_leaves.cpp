#include "cli/load/real_time_leaves.h"

#include <fmt/format.h>

#include <ranges>

#include "base/core/wording.h"

namespace lockstep::host {

bool warn_of_real_time_leaves(const Tree& tree, const std::string& file, const std::string& hint,
                              Diagnostics& diagnostics) {
  constexpr std::size_t kMostNamed = 5;
  const auto text_of = [&](const LeafNode& leaf) {
    return fmt::format("'{}' ({} of plugin '{}')", tree.path(leaf.node), leaf.type->id,
                       leaf.type->plugin);
  };
  const auto in_real_time =
      std::views::filter([](const LeafNode& leaf) { return leaf.type->real_time; });
  const std::string names = some_of(tree.leaves | in_real_time, kMostNamed, text_of);
  if (names.empty()) return false;
  diagnostics.warning(
      "real-time-leaf"_code, {file},
      "on the virtual clock no tick waits for leaves that work in real time: " + names, hint);
  return true;
}

}  // namespace lockstep::host
