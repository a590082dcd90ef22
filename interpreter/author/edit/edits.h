// Changes of one attribute or element. The rest of the text stays as it is: comments, the order of
// attributes, quotes, line ends, references, indentation. Each function reads a document and
// returns the patches; it fails with a sentence if they cannot be made.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/core/problem.h"
#include "language/document/document.h"
#include "language/document/text_edit.h"

namespace lockstep::host {

// Values are given as a program reads them, without references.
// Sets the value; if there is no such attribute, adds it behind the others.
Result<TextEdit> set_attribute(const Document& document, std::uint32_t element,
                               std::string_view name, std::string_view value);
Result<TextEdit> rename_attribute(const Document& document, std::uint32_t element,
                                  std::string_view name, std::string_view new_name);

// `xml` is one element, indented as if it began at the first column. It comes behind `sibling`, and
// its lines get the indentation of that.
Result<TextEdit> insert_behind(const Document& document, std::uint32_t sibling,
                               std::string_view xml);
// The elements of the following are not the root.

// With its lines if nothing else is in them. Comments beside it stay.
Result<TextEdit> delete_element(const Document& document, std::uint32_t element);
// `second` is the sibling behind `first`. Comments in the lines before an element, and behind it in
// its line, go with it.
Result<TextEdit> swap_elements(const Document& document, std::uint32_t first, std::uint32_t second);
// Puts `first` and its siblings up to `last` into a new element; `tag` is what stands between '<'
// and
// '>': "Retry attempts=\"3\"".
Result<TextEdit> wrap_elements(const Document& document, std::uint32_t first, std::uint32_t last,
                               std::string_view tag);
// Replaces it by what is in it.
Result<TextEdit> unwrap_element(const Document& document, std::uint32_t element);

}  // namespace lockstep::host
