// '&' in XML values: the known references, and how bytes of a parsed value map to bytes of the
// file.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace lockstep::host {

// The item at the front of a raw value, and how many bytes it becomes.
struct RawUnit {
  std::size_t raw;   // bytes in the file
  std::size_t read;  // bytes in the value that the reader gives
};

// The reference that `raw` (which begins with '&') begins with: &lt; &gt; &amp; &quot; &apos; or
// the number of an XML character. Nothing when it is none of them.
std::optional<RawUnit> read_reference(std::string_view raw);

// Where in `raw` the byte `read` of the value comes from.
std::size_t raw_offset(std::string_view raw, std::size_t read);

}  // namespace lockstep::host
