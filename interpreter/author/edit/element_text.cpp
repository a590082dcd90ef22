#include "author/edit/element_text.h"

#include <algorithm>

namespace lockstep::host {
namespace {

TagText read_tag(Scanner& scanner, const XmlToken& open) {
  TagText tag{open.begin, open.begin + 1 + open.name.size(), 0, 0, false};
  tag.inside_end = tag.name_end;
  XmlToken token = scanner.next();
  for (; token.kind == TokenKind::Attribute; token = scanner.next()) {
    tag.inside_end = scanner.offset_of(token.value) + token.value.size() + 1;
  }
  tag.is_empty = token.kind == TokenKind::EmptyTagEnd;
  if (tag.is_empty) tag.end = token.begin + 2;
  if (token.kind == TokenKind::TagEnd) tag.end = token.begin + 1;
  return tag;  // the end is 0 if the text is broken
}

void move_by(TagText& tag, std::size_t bytes) {
  for (std::size_t* at : {&tag.begin, &tag.name_end, &tag.inside_end, &tag.end}) *at += bytes;
}

// The scanner of the text from an element on.
Scanner scanner_at(const Document& document, std::uint32_t element) {
  const std::string_view text = document.source()->text();
  return Scanner(text.substr(offset_of(document, document.elements()[element].place)),
                 grammar_of(document));
}

}  // namespace

std::size_t offset_of(const Document& document, Place place) {
  return place.byte - document.source()->place_of(0).byte;
}

Grammar grammar_of(const Document& document) {
  return document.rules().lenient_xml ? Grammar::Lenient : Grammar::Strict;
}

std::optional<TagText> tag_text(const Document& document, std::uint32_t element) {
  Scanner scanner = scanner_at(document, element);
  const XmlToken open = scanner.next();
  if (open.kind != TokenKind::OpenTag) return std::nullopt;
  TagText tag = read_tag(scanner, open);
  if (tag.end == 0) return std::nullopt;
  move_by(tag, offset_of(document, document.elements()[element].place));
  return tag;
}

std::optional<ElementText> element_text(const Document& document, std::uint32_t element) {
  const auto tag = tag_text(document, element);
  if (!tag) return std::nullopt;
  if (tag->is_empty) return ElementText{*tag, tag->end, tag->end};
  Scanner scanner = scanner_at(document, element);
  std::size_t open = 0;
  for (;;) {
    const XmlToken token = scanner.next();
    if (token.kind == TokenKind::End || token.kind == TokenKind::Fault) return std::nullopt;
    if (token.kind == TokenKind::OpenTag) ++open;
    if (token.kind == TokenKind::EmptyTagEnd) --open;
    if (token.kind != TokenKind::CloseTag || --open > 0) continue;
    const std::string_view text = document.source()->text();
    const std::size_t close = tag->begin + token.begin;
    return ElementText{*tag, close, text.find('>', close) + 1};
  }
}

std::optional<AttributeText> attribute_text(const Document& document, const Attribute& attribute) {
  const std::string_view text = document.source()->text();
  const std::size_t begin = offset_of(document, attribute.place);
  const std::size_t name_end = begin + attribute.name.size();
  const std::size_t open = text.find_first_of("\"'", name_end);
  if (attribute.name.empty() || open == std::string_view::npos) return std::nullopt;
  const std::size_t close = text.find(text[open], open + 1);
  if (close == std::string_view::npos) return std::nullopt;
  return AttributeText{begin, name_end, open + 1, close, close + 1};
}

std::optional<std::string_view> indentation(std::string_view text, std::size_t at) {
  // Only the blanks are read: a whole text may be one line, and each of its elements asks.
  const std::size_t begin = text.substr(0, at).find_last_not_of(" \t\r") + 1;  // npos + 1 is 0
  if (begin > 0 && text[begin - 1] != '\n') return std::nullopt;
  return text.substr(begin, at - begin);
}

std::size_t line_begin(std::string_view text, std::size_t at) {
  return at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
}

std::size_t line_end(std::string_view text, std::size_t at) {
  const std::size_t end = std::min(text.find('\n', at), text.size());
  return end > at && end < text.size() && text[end - 1] == '\r' ? end - 1 : end;
}

std::string_view line_end_of(std::string_view text) {
  const auto end = text.find('\n');
  return end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

}  // namespace lockstep::host
