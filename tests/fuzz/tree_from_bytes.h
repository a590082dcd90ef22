// Any bytes as the text of a tree file: the built-in nodes and the leaves of mock_leaf.h, mostly
// with attributes that make sense. For the fuzz targets only.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lockstep::host::fuzz {

std::string tree_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace lockstep::host::fuzz
