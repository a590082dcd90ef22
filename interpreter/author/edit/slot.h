// Where an element goes that comes behind another one, and with which indentation.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "language/document/document.h"

namespace lockstep::host {

// By how much an element is indented more than the one around it: as the first that is, else two
// blanks.
std::string indentation_unit(const Document& document);

struct SlotText {
  std::size_t at;
  std::string before;       // a line end and the indentation, or "" in a line
  std::string indentation;  // of the lines of the new element
};

// Nothing if the text is broken there.
std::optional<SlotText> slot_behind(const Document& document, std::uint32_t sibling);

// An element with what is written about it: comments in the lines before it, and behind it in its
// line.
struct CommentedText {
  std::size_t begin, end;
};
std::optional<CommentedText> commented_text(const Document& document, std::uint32_t element);

// Whether nothing but blanks comes after `at` in its line.
bool ends_line(std::string_view text, std::size_t at);

}  // namespace lockstep::host
