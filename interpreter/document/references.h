// XML values as they are written and as they are read: the known references, and line ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

// The item at the front of a raw value, and what it becomes.
struct RawUnit {
  std::size_t raw;     // bytes in the file
  std::size_t read;    // bytes in the value as it is read
  std::uint32_t code;  // of the character, or the byte where it is one of several
};

// The reference that `raw` (which begins with '&') begins with: &lt; &gt; &amp; &quot; &apos; or
// the number of an XML character. Nothing when it is none of them.
std::optional<RawUnit> read_reference(std::string_view raw);

// The value: the characters in place of references, and one newline for each line end. An '&' that
// begins no reference is one.
std::string read_value(std::string_view raw);

// Where in `raw` the byte `read` of the value comes from.
std::size_t raw_offset(std::string_view raw, std::size_t read);

}  // namespace lockstep
