// Checks whether a text is XML, reports the exact place of a mistake, and finds its elements and
// attributes. It knows bytes and nesting, not the meaning of tags and values. tinyxml2 cannot do
// this: it has no columns and accepts more than XML (docs/decisions/loading.md).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "language/document/element.h"
#include "language/document/scanner.h"

namespace lockstep::host {

// Levels of elements; more than the 1,000 that a tree may have.
constexpr std::size_t kMaxElementDepth = 1'024;
constexpr std::size_t kMaxAttributes = 256;  // of one element

// The first byte that cannot be part of a text in UTF-8 that XML allows. `text` has no byte order
// mark of UTF-8.
std::optional<XmlFault> check_encoding(std::string_view text);

struct WellFormed {
  std::vector<XmlFault> faults;
  bool readable = true;  // false: because of a mistake, the elements are not those of the text
  // In the order of the text; the values of attributes as they are written there.
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> coded;  // those whose values have references or line ends
};

// `first` is the place of the first byte. In the lenient grammar, text and a second root element
// are warned of and left out.
WellFormed check_well_formed(std::string_view text, Place first = {},
                             Grammar grammar = Grammar::Strict);

}  // namespace lockstep::host
