#include "author/scaffold/code_mask.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// Reads a source from its begin to its end.
class Masker {
 public:
  Masker(const SourceLanguage& language, std::string_view text)
      : text_(text), mask_(text), is_python_(language.name == "python") {}

  std::string mask() {
    while (at_ < text_.size()) {
      if (const std::size_t end = end_of_hidden(); end > at_) {
        hide_until(end);
      } else {
        ++at_;
      }
    }
    return mask_;
  }

 private:
  bool has(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  std::size_t after(std::string_view word, std::size_t from) const {
    const auto found = text_.find(word, from);
    return found == text_.npos ? text_.size() : found + word.size();
  }

  // Where what begins here and is no code ends; here if it is code.
  std::size_t end_of_hidden() const {
    if (is_python_) return end_of_hidden_in_python();
    if (has("//")) return std::min(text_.find('\n', at_), text_.size());
    if (has("/*")) return after("*/", at_ + 2);
    if (has("R\"")) return end_of_raw_text();
    if (has("\"")) return end_of_quoted("\"");
    return has("'") && is_character() ? end_of_quoted("'") : at_;
  }

  std::size_t end_of_hidden_in_python() const {
    if (has("#")) return std::min(text_.find('\n', at_), text_.size());
    for (const std::string_view quotes : {"\"\"\"", "'''", "\"", "'"}) {
      if (has(quotes)) return end_of_quoted(quotes);
    }
    return at_;
  }

  std::size_t end_of_raw_text() const {
    const auto open = text_.find('(', at_);
    if (open == text_.npos) return at_;
    return after(")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + '"', open);
  }

  std::size_t end_of_quoted(std::string_view quotes) const {
    for (std::size_t i = at_ + quotes.size(); i < text_.size(); ++i) {
      if (text_[i] == '\\') {
        ++i;
      } else if (text_.substr(i).starts_with(quotes)) {
        return i + quotes.size();
      }
    }
    return text_.size();
  }

  // And no lifetime of Rust, no separator of digits.
  bool is_character() const {
    const std::string_view rest = text_.substr(at_ + 1, 12);
    if (rest.starts_with('\\')) return true;
    const auto end = rest.find('\'');
    return end != rest.npos && end > 0 && end <= 4 &&
           rest.substr(0, end).find_first_of(" ,>;:") == rest.npos;
  }

  void hide_until(std::size_t end) {
    for (; at_ < end; ++at_) {
      if (mask_[at_] != '\n') mask_[at_] = ' ';
    }
  }

  std::string_view text_;
  std::string mask_;
  std::size_t at_ = 0;
  bool is_python_;
};

}  // namespace

std::string code_mask(const SourceLanguage& language, std::string_view text) {
  return Masker(language, text).mask();
}

std::size_t closing_bracket(std::string_view mask, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < mask.size(); ++i) {
    if (mask[i] == '(' || mask[i] == '[' || mask[i] == '{') ++depth;
    if (mask[i] == ')' || mask[i] == ']' || mask[i] == '}') --depth;
    if (depth == 0) return i;
  }
  return mask.npos;
}

}  // namespace lockstep::host
