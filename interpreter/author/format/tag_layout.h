// The attributes of one tag: their order, and the lines that they are in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "author/edit/text_edit.h"
#include "author/format/format.h"
#include "language/document/scanner.h"

namespace lockstep::host {

class TagLayout {
 public:
  TagLayout(std::string_view text, std::string_view line_end, const FormatOptions& options)
      : text_(text), line_end_(line_end), options_(options) {}

  void begin(const XmlToken& open, std::size_t indentation);
  // Between the quotes is `value`, a part of the text.
  void add(const XmlToken& attribute);
  // `end` is the TagEnd or the EmptyTagEnd. Adds the patches to `edit`.
  void end(const XmlToken& end, TextEdit& edit);

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

// Replaces these bytes by `wanted`, unless they are.
void set_gap(TextEdit& edit, std::string_view text, std::size_t begin, std::size_t end,
             std::string_view wanted);

}  // namespace lockstep::host
