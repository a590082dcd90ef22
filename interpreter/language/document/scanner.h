// Cuts the bytes of an XML text into tokens, each with its exact place. It knows the syntax of
// tags, but not their meaning or nesting. The check of well-formedness and the places in a Document
// use it, because tinyxml2 keeps no columns.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "language/document/cursor.h"

namespace lockstep::host {

// Lenient: also what programs for BehaviorTree.CPP write. '<' and '&' in values, no blank between
// attributes, "--" in comments, any declaration and DOCTYPE.
enum class Grammar : bool { Strict, Lenient };

enum class TokenKind {
  OpenTag,      // <name
  Attribute,    // name="value", between OpenTag and TagEnd
  TagEnd,       // >
  EmptyTagEnd,  // />
  CloseTag,     // </name>
  Text,         // that is not only blank, or a CDATA section
  Comment,
  Instruction,  // <?name …?>, so the XML declaration too
  Doctype,
  End,
  Fault,
};

struct XmlToken {
  TokenKind kind = TokenKind::End;
  std::size_t begin = 0;       // its first byte
  std::string_view name = {};  // of a tag or an attribute
  // The text of an attribute between the quotes, what counts of a Text, or all of an Instruction or
  // a Doctype.
  std::string_view value = {};
  bool is_coded = false;  // an attribute with a reference or a line end: it is read as another
};

class Scanner {
 public:
  explicit Scanner(std::string_view text, Grammar grammar = Grammar::Strict)
      : text_(text), at_(text), is_lenient_(grammar == Grammar::Lenient) {}

  // The next token. After End or Fault, that one again.
  XmlToken next();
  const std::optional<XmlFault>& fault() const { return fault_; }
  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - text_.data());
  }

 private:
  XmlToken content();
  XmlToken inside_tag();
  XmlToken markup();
  XmlToken declaration();
  XmlToken no_tag(std::size_t offset);
  XmlToken attribute(std::size_t begin, std::string_view name);
  XmlToken close_tag();
  XmlToken comment();
  XmlToken character_data();
  // `skip` moves behind it.
  XmlToken skipped(TokenKind kind, std::optional<XmlFault> (*skip)(Cursor&));
  // The same for what ends at `end`, whatever is inside.
  XmlToken skipped(TokenKind kind, std::string_view end);
  XmlToken fail(std::size_t offset, std::string message, std::string hint = {});
  std::string_view rest() const { return at_.rest(); }

  std::string_view text_;
  Cursor at_;
  bool is_lenient_;
  std::string_view tag_;  // the tag that is open: its attributes come next
  std::size_t tag_begin_ = 0;
  std::optional<XmlFault> fault_;
};

}  // namespace lockstep::host
