// Whether a text is XML, with the exact place of what is wrong, and where its elements and
// attributes are: the reader behind Document says only the line, and takes more than XML allows. It
// knows nesting and bytes, not what tags and values mean.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "document/element.h"
#include "document/scanner.h"

namespace lockstep {

// Elements inside each other. tinyxml2 allows 100 levels, of which it needs two for itself.
constexpr std::size_t kMaxElementDepth = 98;
// Of one element: tinyxml2 compares each with all before it.
constexpr std::size_t kMaxAttributes = 256;

// The first byte that cannot be part of a text in UTF-8 that XML allows. `text` has no byte order
// mark of UTF-8.
std::optional<XmlFault> check_encoding(std::string_view text);

struct WellFormed {
  std::vector<XmlFault> faults;
  bool readable = true;  // false: a fault is such that the reader refuses the text
  // In the order of the text; the values of attributes as they are written there.
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> coded;  // those whose values the reader reads as others
  // Processing instructions and the like: XML, but where the reader does not take it.
  std::vector<std::string_view> unread;
};

// `first` is the place of the first byte.
WellFormed check_well_formed(std::string_view text, Place first = {});

}  // namespace lockstep
