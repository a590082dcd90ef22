// Where the parts of an element and of an attribute are in the text of their document, in bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "language/document/document.h"
#include "language/document/scanner.h"

namespace lockstep::host {

struct AttributeText {
  std::size_t begin, name_end;         // its name
  std::size_t value_begin, value_end;  // between the quotes
  std::size_t end;                     // behind the closing quote

  char quote_in(std::string_view text) const { return text[value_begin - 1]; }
};

struct TagText {
  std::size_t begin;       // its '<'
  std::size_t name_end;    // behind its name
  std::size_t inside_end;  // behind its last attribute, or its name
  std::size_t end;         // behind '>' or '/>'
  bool is_empty;           // it ends in '/>'
};

struct ElementText {
  TagText tag;
  std::size_t close;  // the '</' of its closing tag; tag.end if there is none
  std::size_t end;    // behind all of it
};

// A byte of the text of a document from its place.
std::size_t offset_of(const Document& document, Place place);
Grammar grammar_of(const Document& document);

// Nothing if the text of the document is broken there.
std::optional<TagText> tag_text(const Document& document, std::uint32_t element);
std::optional<ElementText> element_text(const Document& document, std::uint32_t element);
// `attribute` is not a text of an element.
std::optional<AttributeText> attribute_text(const Document& document, const Attribute& attribute);

// The blanks before `at` if nothing else is in its line before it.
std::optional<std::string_view> indentation(std::string_view text, std::size_t at);
// Where the line of `at` begins, and where its line end does.
std::size_t line_begin(std::string_view text, std::size_t at);
std::size_t line_end(std::string_view text, std::size_t at);
// "\r\n" if the first line of the text ends so.
std::string_view line_end_of(std::string_view text);

}  // namespace lockstep::host
