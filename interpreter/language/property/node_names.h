// Which node a property means: a path, or an end of one that no other path has.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "base/core/problem.h"

namespace lockstep::host {

// The index of the node. The error lists the candidates, or the nearest name.
Result<std::uint32_t> find_node(std::string_view name, std::span<const std::string> paths);

// The same among many paths, without a look at all of them.
class PathEnds {
 public:
  PathEnds() = default;  // of no paths
  explicit PathEnds(std::span<const std::string> paths);
  // One of the nodes from `first` up to `end` of the paths that it was made of. Nothing: none, or
  // several.
  std::optional<std::uint32_t> find(std::string_view name, std::span<const std::string> paths,
                                    std::uint32_t first, std::uint32_t end) const;

 private:
  std::vector<std::uint32_t> nodes_;  // by the last segments of their paths
};

// The path of a node, or an end of one, with which `text` begins although it needs quotes; else "".
std::string_view quoted_name(std::string_view text, std::span<const std::string> paths);

}  // namespace lockstep::host
