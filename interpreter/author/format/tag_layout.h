// The attributes of one tag: their order, and the lines that they are in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "author/format/format.h"
#include "language/document/scanner.h"
#include "language/document/text_edit.h"

namespace lockstep::host {

// The edit, and what it changes: the blanks between tags and between attributes.
class Gaps {
 public:
  explicit Gaps(std::string_view text) : text_(text) {}

  void set(std::size_t begin, std::size_t end, std::string_view wanted);
  // For what is not a blank.
  void replace(std::size_t begin, std::size_t end, std::string_view wanted);

  // That of the first line which ends in a gap. No edit changes the line ends of comments and
  // values, so these must not decide: a second edit would find another one first.
  std::optional<std::string_view> line_end() const { return line_end_; }
  TextEdit take() { return std::move(edit_); }

 private:
  std::string_view text_;
  TextEdit edit_;
  std::optional<std::string_view> line_end_;
};

class TagLayout {
 public:
  TagLayout(std::string_view text, std::string_view line_end, const FormatOptions& options)
      : text_(text), line_end_(line_end), options_(options) {}

  void begin(const XmlToken& open, std::size_t indentation);
  // Between the quotes is `value`, a part of the text.
  void add(const XmlToken& attribute);
  // `end` is the TagEnd or the EmptyTagEnd.
  void end(const XmlToken& end, Gaps& gaps);

 private:
  struct Part {
    std::size_t begin, end;
    std::string_view name, value;  // the value with its quotes
  };

  std::vector<const Part*> ordered() const;

  std::string_view text_, line_end_;
  const FormatOptions& options_;
  std::size_t name_end_ = 0, column_ = 0;
  std::vector<Part> parts_;
};

}  // namespace lockstep::host
