// The elements of an XML file and their attributes, flat and in pre-order. Views into the text of
// their document.
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep {

struct Attribute {
  std::string_view name;
  std::string_view value;  // entities resolved, and arguments once the project has substituted them
};

struct Element {
  std::string_view tag;
  std::uint32_t end;  // one past its last descendant in Document::elements(); children as in Tree
  std::uint32_t first_attribute;
  std::uint32_t attribute_count;
};

}  // namespace lockstep
