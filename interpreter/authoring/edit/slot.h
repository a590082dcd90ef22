// Where a new element goes, and with which indentation.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "authoring/edit/edits.h"
#include "authoring/edit/element_text.h"

namespace lockstep::host {

// By how much an element is indented more than the one around it: as the first that is, else two
// blanks.
std::string indentation_unit(const Document& document);

// Replaces [begin, end) by `before`, the element and `after`.
struct ChildSlotText {
  std::size_t begin, end;
  std::string before, after;
  std::string indentation;  // of the new element's lines
};

// Nothing if the text is broken there.
std::optional<ChildSlotText> slot_text(const Document& document, ChildSlot slot);

// Whether nothing but blanks comes after `at` in its line.
bool ends_line(std::string_view text, std::size_t at);

}  // namespace lockstep::host
