#include "author/convert/strict_xml.h"

#include <algorithm>

namespace lockstep::host {

bool is_strict_xml(std::string_view text, const XmlToken& token) {
  const bool is_declaration = token.value.starts_with("<?xml") && is_xml_blank(token.value[5]);
  if (is_declaration && text.find('<') != token.begin) return false;
  if (is_declaration && token.begin > 0 && is_xml_blank(text[token.begin - 1])) return false;
  Scanner strict(token.value);
  return strict.next().kind == token.kind && strict.next().kind == TokenKind::End;
}

std::size_t end_of_text(std::string_view text, const XmlToken& token) {
  if (text.substr(token.begin).starts_with("<![CDATA[")) return text.find("]]>", token.begin) + 3;
  auto end = std::min(text.find('<', token.begin + 1), text.size());
  while (end > token.begin && is_xml_blank(text[end - 1])) --end;
  return end;
}

std::optional<std::string> comment_in_xml(std::string_view inside) {
  if (inside.find("--") == std::string_view::npos && !inside.ends_with('-')) return std::nullopt;
  std::string text;
  for (const char c : inside) {
    if (c == '-' && text.ends_with('-')) text += ' ';
    text += c;
  }
  if (text.ends_with('-')) text += ' ';
  return text;
}

}  // namespace lockstep::host
