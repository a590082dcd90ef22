// Reads a text that may be broken, as it is while somebody types: which elements and attributes are
// there as far as anybody can know. What is wrong with the text is what Document::parse says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "language/document/byte_range.h"

namespace lockstep::host {

// Views and bytes are of the text. Values are as they are written, with references and arguments.
struct TolerantAttribute {
  std::string_view name;
  std::string_view value = {};  // up to the quote or, if it is not closed, as far as it seems
  std::size_t begin = 0;        // of the name
  bool has_quote = false;       // else there is no value so far
  bool is_closed = false;
};

struct TolerantElement {
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::string_view tag;     // "" while only '<' is there
  std::size_t begin = 0;    // of '<'
  std::size_t tag_end = 0;  // behind the start tag
  std::size_t close = 0;    // of its end tag; `end` where it has none
  std::size_t end = 0;      // behind all of it
  std::uint32_t parent = kNone;
  std::uint32_t last = 0;  // one past its last descendant
  std::uint32_t first_attribute = 0, attribute_count = 0;
  bool is_tag_closed = false;  // the start tag has its '>'
  bool is_closed = false;      // "/>", or an end tag
  std::string_view text = {};  // the first text that is directly in it

  // Whether a byte is inside of the start tag: behind '<', and not behind '>'.
  bool has_in_tag(std::size_t byte) const {
    return byte > begin && (byte < tag_end || (byte == tag_end && !is_tag_closed));
  }
};

struct TolerantTree {
  std::string_view text;
  std::vector<TolerantElement> elements;  // in the order of the text; several may have no parent
  std::vector<TolerantAttribute> attributes;
  std::vector<std::size_t> comments = {};  // begin and end of each, in turn

  std::span<const TolerantAttribute> attributes_of(const TolerantElement& element) const {
    return std::span(attributes).subspan(element.first_attribute, element.attribute_count);
  }
  // "" when there is none.
  std::string_view value_of(const TolerantElement& element, std::string_view name) const;
  const TolerantElement* parent_of(const TolerantElement& element) const {
    return element.parent == TolerantElement::kNone ? nullptr : &elements[element.parent];
  }
  // The innermost element around a byte, in its start tag or between its tags.
  const TolerantElement* at(std::size_t byte) const;
  bool is_in_comment(std::size_t byte) const;
  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - text.data());
  }
};

// The bytes of a part of the text.
inline ByteRange range_of(const TolerantTree& tree, std::string_view part) {
  const std::size_t begin = tree.offset_of(part);
  return {begin, begin + part.size()};
}

TolerantTree read_tolerantly(std::string_view text);

}  // namespace lockstep::host
