// Where something stands in the texts that a definition is made from. As small as an index: a byte
// of all texts, one after the other. Sources (document/sources.h) knows its file, line and column.
#pragma once

#include <cstdint>

namespace lockstep {

struct Place {
  std::uint32_t byte = 0;
};

}  // namespace lockstep
