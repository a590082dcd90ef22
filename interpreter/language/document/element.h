// The elements of an XML file and their attributes, flat and in pre-order. Views into the text of
// their document; their places stay the same when their values are replaced.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/core/place.h"

namespace lockstep::host {

struct Attribute {
  std::string_view name;   // "": it is the text of the element, which only <property> has
  std::string_view value;  // entities resolved, and arguments once the project has substituted them
  Place place = {};        // of its name; of a text: of its first byte
};

struct Element {
  std::string_view tag;
  std::uint32_t end;  // one past its last descendant in Document::elements(); children as in Tree
  std::uint32_t first_attribute;
  std::uint32_t attribute_count;
  Place place = {};  // of its '<'
};

// Null when there is none.
inline const Attribute* find_attribute(std::span<const Attribute> attributes,
                                       std::string_view name) {
  for (const Attribute& attribute : attributes)
    if (attribute.name == name) return &attribute;
  return nullptr;
}

}  // namespace lockstep::host
