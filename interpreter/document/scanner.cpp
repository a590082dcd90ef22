#include "document/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace lockstep {
namespace {

enum CharacterClass : std::uint8_t { Other, NameStart, NamePart };

// A look at this table for each byte of a file is what the check of a correct one costs.
constexpr auto kClasses = [] {
  std::array<CharacterClass, 256> classes{};
  for (unsigned c = 'a'; c <= 'z'; ++c) classes[c] = NameStart;
  for (unsigned c = 'A'; c <= 'Z'; ++c) classes[c] = NameStart;
  for (unsigned c = 0x80; c <= 0xFF; ++c) classes[c] = NameStart;
  classes['_'] = classes[':'] = NameStart;
  for (unsigned c = '0'; c <= '9'; ++c) classes[c] = NamePart;
  classes['-'] = classes['.'] = NamePart;
  return classes;
}();

constexpr CharacterClass class_of(char c) {
  return kClasses[static_cast<unsigned char>(c)];
}

constexpr auto kInValue = [] {
  std::array<bool, 256> counts{};
  for (const char c : std::string_view("\"'<&\r")) counts[static_cast<unsigned char>(c)] = true;
  return counts;
}();

constexpr bool counts_in_value(char c) {
  return kInValue[static_cast<unsigned char>(c)];
}

}  // namespace

Token Scanner::next() {
  if (fault_) return {TokenKind::Fault, fault_->offset};
  return tag_.empty() ? content() : inside_tag();
}

Token Scanner::content() {
  const auto begin = position_;
  skip_blanks();
  if (rest().empty()) return {TokenKind::End, position_};
  if (text_[position_] == '<') return markup();
  position_ = std::min(text_.find('<', position_), text_.size());
  return {TokenKind::Text, begin, {}, text_.substr(begin, position_ - begin)};
}

Token Scanner::markup() {
  const auto begin = position_;
  const char second = begin + 1 < text_.size() ? text_[begin + 1] : '\0';
  if (second == '/') return close_tag();
  if (second == '!' || second == '?') return declaration();
  ++position_;
  tag_ = take_name();
  tag_begin_ = begin;
  if (tag_.empty()) return no_tag(begin);
  return {TokenKind::OpenTag, begin, tag_};
}

Token Scanner::declaration() {
  if (rest().starts_with("<!--")) return enclosed(TokenKind::Comment, "<!--", "-->", "comment");
  if (rest().starts_with("<![CDATA["))
    return enclosed(TokenKind::Text, "<![CDATA[", "]]>", "CDATA section");
  if (rest().starts_with("<?"))
    return enclosed(TokenKind::Instruction, "<?", "?>", "processing instruction");
  if (rest().starts_with("<!DOCTYPE")) return doctype();
  return no_tag(position_);
}

Token Scanner::no_tag(std::size_t offset) {
  return fail(offset, "'<' does not begin a tag", "write '&lt;' for the character itself");
}

Token Scanner::inside_tag() {
  const bool blanks = skip_blanks();
  const auto begin = position_;
  if (rest().starts_with('>') || rest().starts_with("/>")) {
    const bool empty = rest()[0] == '/';
    position_ += empty ? 2 : 1;
    const auto name = std::exchange(tag_, std::string_view());
    return {empty ? TokenKind::EmptyTagEnd : TokenKind::TagEnd, begin, name};
  }
  if (rest().empty()) return fail(tag_begin_, fmt::format("the tag '<{}' is not closed", tag_));
  if (class_of(text_[begin]) != NameStart) {
    const auto hint = fmt::format("the tag '<{}' needs '>' or '/>' at its end", tag_);
    return fail(begin, fmt::format("unexpected '{}' in the tag '<{}'", text_[begin], tag_), hint);
  }
  if (!blanks) return fail(begin, "expected a blank before the attribute");
  return attribute();
}

Token Scanner::attribute() {
  const auto begin = position_;
  const auto name = take_name();
  skip_blanks();
  if (!rest().starts_with('='))
    return fail(begin, fmt::format("attribute '{}' has no value", name),
                fmt::format("write {}=\"…\"", name));
  ++position_;
  skip_blanks();
  const auto open = position_;
  if (!rest().starts_with('"') && !rest().starts_with('\''))
    return fail(open, fmt::format("expected a quote before the value of '{}'", name),
                fmt::format("write {}=\"…\"", name));
  bool is_coded = false;
  for (auto at = open + 1; at < text_.size(); ++at) {
    const char c = text_[at];
    if (!counts_in_value(c)) continue;
    if (c == text_[open]) {
      position_ = at + 1;
      return {TokenKind::Attribute, begin, name, text_.substr(open + 1, at - open - 1), is_coded};
    }
    // A quote that is forgotten finds the next value's, far below.
    if (c == '<')
      return fail(at, fmt::format("'<' in the value of '{}'", name),
                  "write '&lt;', or close the quote before it");
    is_coded |= c == '&' || c == '\r';
  }
  return fail(open, fmt::format("the quote of '{}' is not closed", name));
}

Token Scanner::close_tag() {
  const auto begin = position_;
  position_ += 2;
  const auto name = take_name();
  if (name.empty()) return fail(begin, "'</' needs the name of the element that it closes");
  skip_blanks();
  if (!rest().starts_with('>'))
    return fail(begin, fmt::format("the tag '</{}' is not closed", name));
  ++position_;
  return {TokenKind::CloseTag, begin, name};
}

Token Scanner::enclosed(TokenKind kind, std::string_view open, std::string_view close,
                        std::string_view what) {
  const auto begin = position_;
  const auto inside = begin + open.size();
  const auto end = text_.find(close, inside);
  if (end == std::string_view::npos)
    return fail(begin, fmt::format("the {} is not closed", what),
                fmt::format("'{}' ends it", close));
  position_ = end + close.size();
  return {kind, begin, {}, text_.substr(inside, end - inside)};
}

Token Scanner::doctype() {
  const auto begin = position_;
  const auto end = text_.find_first_of("[>", begin);
  if (end == std::string_view::npos) return fail(begin, "the DOCTYPE is not closed");
  if (text_[end] == '[') return fail(end, "definitions in a DOCTYPE are not supported");
  position_ = end + 1;
  return {TokenKind::Doctype, begin};
}

Token Scanner::fail(std::size_t offset, std::string message, std::string hint) {
  fault_ = XmlFault{offset, std::move(message), std::move(hint)};
  return {TokenKind::Fault, offset};
}

std::string_view Scanner::take_name() {
  const auto begin = position_;
  if (begin == text_.size() || class_of(text_[begin]) != NameStart) return {};
  while (position_ < text_.size() && class_of(text_[position_]) != Other) ++position_;
  return text_.substr(begin, position_ - begin);
}

bool Scanner::skip_blanks() {
  const auto begin = position_;
  while (position_ < text_.size() && is_xml_blank(text_[position_])) ++position_;
  return position_ > begin;
}

}  // namespace lockstep
