// A part of a text, and the part that a message is about.
#pragma once

#include <compare>
#include <cstddef>
#include <string_view>

#include "base/core/diagnostics.h"
#include "language/document/lines.h"

namespace lockstep::host {

struct ByteRange {
  std::size_t begin = 0, end = 0;
  bool has(std::size_t byte) const { return byte >= begin && byte <= end; }
  friend auto operator<=>(const ByteRange&, const ByteRange&) = default;
};

// Which bytes of `text` a message at this place is about: a tag, a name, a value.
ByteRange range_of(std::string_view text, const LineIndex& lines, const SourceLocation& place);

}  // namespace lockstep::host
