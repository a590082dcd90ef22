// The text of a file, as it is on the disk.
#pragma once

#include <string_view>

namespace lockstep::host {

// The byte order mark, which a document leaves out, or "".
constexpr std::string_view byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? kMark : std::string_view();
}

}  // namespace lockstep::host
