// A position in an XML text that moves over blanks, names and quoted texts. Shared by the scanner
// of tags and the grammar of what is outside of them (prolog.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep::host {

// An error at a byte of a text. (Fault is the error of a leaf: engine/ticker.h.)
struct XmlFault {
  std::size_t offset = 0;
  std::string message;
  std::string hint = {};
  bool is_warning = false;
};

constexpr bool is_xml_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// The bytes at the front of `text` that make a name, in XML 1.0. `text` is UTF-8.
std::size_t xml_name_length(std::string_view text);

class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  std::size_t position() const { return position_; }
  void go_to(std::size_t position) { position_ = position; }
  std::string_view rest() const { return {text_.data() + position_, text_.size() - position_}; }

  bool at_end() const { return position_ == text_.size(); }
  // Whether this byte comes next.
  bool is_at(char c) const { return !at_end() && text_[position_] == c; }
  bool skip(char c) {
    const bool is_here = is_at(c);
    position_ += is_here ? 1 : 0;
    return is_here;
  }
  bool skip(std::string_view word) {
    const bool is_here = rest().starts_with(word);
    if (is_here) position_ += word.size();
    return is_here;
  }

  bool skip_blanks() {
    const auto begin = position_;
    while (position_ < text_.size() && is_xml_blank(text_[position_])) ++position_;
    return position_ > begin;
  }

  // "" when no name begins here.
  std::string_view take_name() {
    const char* const begin = text_.data() + position_;
    const char* const last = text_.data() + text_.size();
    if (begin == last || (class_of(*begin) & (kStart | kWide)) == 0) return {};
    unsigned seen = 0;
    const char* end = begin;
    for (unsigned it = 0; end != last && (it = class_of(*end)) != kOther; ++end) seen |= it;
    std::string_view name(begin, static_cast<std::size_t>(end - begin));
    if ((seen & kWide) != 0) name = name.substr(0, xml_name_length(name));
    position_ += name.size();
    return name;
  }

  // The text between the quotes that begin here; nothing if there are no quotes or they are not
  // closed.
  std::optional<std::string_view> take_quoted();

 private:
  // Looking up each byte of a name in this table is the main cost of checking a correct file. Bytes
  // beyond ASCII are classified only where there are any.
  enum : std::uint8_t { kOther = 0, kStart = 1, kPart = 2, kWide = 4 };
  static constexpr std::uint8_t class_of(char c) { return kClasses[static_cast<unsigned char>(c)]; }
  static constexpr auto kClasses = [] {
    std::array<std::uint8_t, 256> classes{};
    for (unsigned c = 'a'; c <= 'z'; ++c) classes[c] = kStart;
    for (unsigned c = 'A'; c <= 'Z'; ++c) classes[c] = kStart;
    for (unsigned c = '0'; c <= '9'; ++c) classes[c] = kPart;
    for (unsigned c = 0x80; c <= 0xFF; ++c) classes[c] = kWide;
    classes['_'] = classes[':'] = kStart;
    classes['-'] = classes['.'] = kPart;
    return classes;
  }();

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace lockstep::host
