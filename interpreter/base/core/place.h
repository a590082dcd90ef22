// A place in the texts that a definition is made from, stored as an index: a byte in the
// concatenation of all texts. Sources (language/document/sources.h) maps it to file, line and
// column.
#pragma once

#include <cstdint>

namespace lockstep::host {

struct Place {
  std::uint32_t byte = 0;
};

}  // namespace lockstep::host
