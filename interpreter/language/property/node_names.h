// Which node a property means: a path, or an end of one that no other path has.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "base/core/problem.h"

namespace lockstep::host {

// The index of the node. The error lists the candidates, or the nearest name.
Result<std::uint32_t> find_node(std::string_view name, std::span<const std::string> paths);

// The path of a node, or an end of one, with which `text` begins although it needs quotes; else "".
std::string_view quoted_name(std::string_view text, std::span<const std::string> paths);

}  // namespace lockstep::host
