// Changes of one attribute or element. The rest of the text stays as it is: comments, the order of
// attributes, quotes, line ends, references, indentation. Each function reads a document and
// returns the patches; it fails with a sentence if they cannot be made.
#pragma once

#include <cstdint>
#include <string_view>

#include "authoring/edit/text_edit.h"
#include "core/problem.h"
#include "document/document.h"

namespace lockstep::host {

// Values are given as a program reads them, without references.
// Sets the value; if there is no such attribute, adds it behind the others.
Result<TextEdit> set_attribute(const Document& document, std::uint32_t element,
                               std::string_view name, std::string_view value);
Result<TextEdit> remove_attribute(const Document& document, std::uint32_t element,
                                  std::string_view name);
Result<TextEdit> rename_attribute(const Document& document, std::uint32_t element,
                                  std::string_view name, std::string_view new_name);

// Renames the element itself, both of its tags.
Result<TextEdit> rename_element(const Document& document, std::uint32_t element,
                                std::string_view tag);

// A place among the children of `parent`: before the child `index`; behind the last one if there
// are no more.
struct ChildSlot {
  std::uint32_t parent = 0;
  std::uint32_t index = 0;
};

// `xml` is one element, or several, indented as if it began at the first column. Its lines get the
// indentation of the place.
Result<TextEdit> insert_element(const Document& document, ChildSlot slot, std::string_view xml);
// With its lines if nothing else is in them. Comments beside it stay.
Result<TextEdit> delete_element(const Document& document, std::uint32_t element);
// `slot` counts the children as they are before the move.
Result<TextEdit> move_element(const Document& document, std::uint32_t element, ChildSlot slot);
// Puts it into a new element; `tag` is what stands between '<' and '>': "Retry attempts=\"3\"".
Result<TextEdit> wrap_element(const Document& document, std::uint32_t element,
                              std::string_view tag);
// Replaces it by what is in it.
Result<TextEdit> unwrap_element(const Document& document, std::uint32_t element);

}  // namespace lockstep::host
