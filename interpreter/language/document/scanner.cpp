#include "language/document/scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/core/utf8.h"
#include "base/core/wording.h"
#include "language/document/prolog.h"

namespace lockstep::host {
namespace {

constexpr auto kInValue = [] {
  std::array<bool, 256> counts{};
  for (const char c : std::string_view("\"'<&\r")) counts[static_cast<unsigned char>(c)] = true;
  return counts;
}();

constexpr bool counts_in_value(char c) {
  return kInValue[static_cast<unsigned char>(c)];
}

}  // namespace

XmlToken Scanner::next() {
  if (fault_) return {TokenKind::Fault, fault_->offset};
  return tag_.empty() ? content() : inside_tag();
}

XmlToken Scanner::content() {
  const auto begin = at_.position();
  at_.skip_blanks();
  if (at_.at_end()) return {TokenKind::End, at_.position()};
  if (at_.is_at('<')) return markup();
  const auto end = std::min(text_.find('<', at_.position()), text_.size());
  at_.go_to(end);
  return {TokenKind::Text, begin, {}, text_.substr(begin, end - begin)};
}

XmlToken Scanner::markup() {
  const auto begin = at_.position();
  const char second = begin + 1 < text_.size() ? text_[begin + 1] : '\0';
  if (second == '/') return close_tag();
  if (second == '!' || second == '?') return declaration();
  at_.skip('<');
  tag_ = at_.take_name();
  tag_begin_ = begin;
  if (tag_.empty()) return no_tag(begin);
  return {TokenKind::OpenTag, begin, tag_};
}

XmlToken Scanner::declaration() {
  if (rest().starts_with("<!--")) return comment();
  if (rest().starts_with("<![CDATA[")) return character_data();
  if (is_lenient_) {
    if (rest().starts_with("<?")) return skipped(TokenKind::Instruction, "?>");
    return skipped(TokenKind::Doctype, ">");
  }
  if (rest().starts_with("<?")) return skipped(TokenKind::Instruction, skip_instruction);
  if (rest().starts_with("<!DOCTYPE")) return skipped(TokenKind::Doctype, skip_doctype);
  return no_tag(at_.position());
}

XmlToken Scanner::no_tag(std::size_t offset) {
  return fail(offset, "'<' does not begin a tag", "write '&lt;' for the character itself");
}

XmlToken Scanner::inside_tag() {
  const bool blanks = at_.skip_blanks();
  const auto begin = at_.position();
  const bool is_slash = at_.is_at('/');
  if (at_.is_at('>') || (is_slash && rest().substr(1).starts_with('>'))) {
    at_.go_to(begin + (is_slash ? 2 : 1));
    const auto name = std::exchange(tag_, std::string_view());
    return {is_slash ? TokenKind::EmptyTagEnd : TokenKind::TagEnd, begin, name};
  }
  if (at_.at_end())
    return fail(tag_begin_, fmt::format("the tag '<{}' is not closed", brief(tag_)));
  const auto name = at_.take_name();
  if (name.empty()) {
    const auto hint = fmt::format("the tag '<{}' needs '>' or '/>' at its end", brief(tag_));
    const auto found = rest().substr(0, utf8_length(rest()));
    return fail(begin, fmt::format("unexpected '{}' in the tag '<{}'", found, brief(tag_)), hint);
  }
  if (!blanks && !is_lenient_) return fail(begin, "expected whitespace before the attribute");
  return attribute(begin, name);
}

XmlToken Scanner::attribute(std::size_t begin, std::string_view name) {
  at_.skip_blanks();
  if (!at_.skip('='))
    return fail(begin, fmt::format("attribute '{}' has no value", brief(name)),
                fmt::format("write {}=\"…\"", brief(name)));
  at_.skip_blanks();
  const auto open = at_.position();
  if (!at_.is_at('"') && !at_.is_at('\''))
    return fail(open, fmt::format("expected a quote before the value of '{}'", brief(name)),
                fmt::format("write {}=\"…\"", brief(name)));
  const char quote = text_[open];
  bool is_coded = false;
  for (const char* at = text_.data() + open + 1; at != text_.data() + text_.size(); ++at) {
    if (!counts_in_value(*at)) continue;
    const std::size_t offset = offset_of({at, 1});
    if (*at == quote) {
      at_.go_to(offset + 1);
      return {TokenKind::Attribute,
              begin,
              name,
              {text_.data() + open + 1, offset - open - 1},
              is_coded};
    }
    // A quote that is forgotten finds the next value's, far below.
    if (*at == '<' && !is_lenient_)
      return fail(offset, fmt::format("'<' in the value of '{}'", brief(name)),
                  "write '&lt;', or close the quote before it");
    is_coded |= *at == '&' || *at == '\r';
  }
  return fail(open, fmt::format("the quote of '{}' is not closed", brief(name)));
}

XmlToken Scanner::close_tag() {
  const auto begin = at_.position();
  at_.skip("</");
  const auto name = at_.take_name();
  if (name.empty()) return fail(begin, "'</' needs the name of the element that it closes");
  at_.skip_blanks();
  if (!at_.skip('>')) return fail(begin, fmt::format("the tag '</{}' is not closed", brief(name)));
  return {TokenKind::CloseTag, begin, name};
}

XmlToken Scanner::comment() {
  const auto begin = at_.position();
  at_.skip("<!--");
  const auto end = text_.find("--", at_.position());
  if (text_.find("-->", at_.position()) == std::string_view::npos)
    return fail(begin, "the comment is not closed", "'-->' ends it");
  at_.go_to(is_lenient_ ? text_.find("-->", end) + 2 : end + 2);
  if (!at_.skip('>')) return fail(end, "'--' in a comment", "XML does not allow it: write '- -'");
  return {TokenKind::Comment, begin};
}

XmlToken Scanner::character_data() {
  const auto begin = at_.position();
  at_.skip("<![CDATA[");
  const auto inside = at_.position();
  const auto end = text_.find("]]>", inside);
  if (end == std::string_view::npos)
    return fail(begin, "the CDATA section is not closed", "']]>' ends it");
  at_.go_to(end + 3);
  return {TokenKind::Text, begin, {}, text_.substr(inside, end - inside)};
}

XmlToken Scanner::skipped(TokenKind kind, std::optional<XmlFault> (*skip)(Cursor&)) {
  const auto begin = at_.position();
  if (auto fault = skip(at_))
    return fail(fault->offset, std::move(fault->message), std::move(fault->hint));
  return {kind, begin, {}, text_.substr(begin, at_.position() - begin)};
}

XmlToken Scanner::skipped(TokenKind kind, std::string_view end) {
  const auto begin = at_.position();
  const auto found = text_.find(end, begin);
  if (found == std::string_view::npos)
    return fail(begin, fmt::format("'{}' is not closed", rest().substr(0, 2)),
                fmt::format("'{}' ends it", end));
  at_.go_to(found + end.size());
  return {kind, begin, {}, text_.substr(begin, at_.position() - begin)};
}

XmlToken Scanner::fail(std::size_t offset, std::string message, std::string hint) {
  fault_ = XmlFault{offset, std::move(message), std::move(hint)};
  return {TokenKind::Fault, offset};
}

}  // namespace lockstep::host
