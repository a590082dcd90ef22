// The element, attribute or value at a position of a text, also of a broken one.
#pragma once

#include <string_view>

#include "author/server/positions.h"
#include "language/document/tolerant.h"

namespace lockstep::host {

struct Site {
  enum class Part : unsigned char {
    Nothing,  // a comment, or the text is no XML here
    Content,  // between tags
    Tag,
    EndTag,
    AttributeName,
    AttributeValue
  } part = Part::Nothing;
  // In whose tag it is, or between whose tags. Null: outside of all.
  const TolerantElement* element = nullptr;
  const TolerantAttribute* attribute = nullptr;  // whose name or value it is in, if there is one
  ByteRange word;                                // that name or value
};

Site site_at(const TolerantTree& tree, std::size_t byte);

// An element in one of whose tags a selection begins, and the one of it and its siblings behind it
// in which the selection ends. Null: there are none. A cursor, which selects nothing, in the
// indentation of a line is where the line begins.
struct SelectedElements {
  const TolerantElement *first = nullptr, *last = nullptr;
};
SelectedElements selected_elements(const TolerantTree& tree, ByteRange selection);

}  // namespace lockstep::host
