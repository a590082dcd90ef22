#include "author/edit/line_shift.h"

#include <algorithm>
#include <vector>

namespace lockstep::host {
namespace {

struct FixedPart {
  std::size_t begin, end;
};

// The bytes of a token that have a meaning; none of a tag, a comment or the end.
FixedPart fixed_part(const Scanner& scanner, const XmlToken& token, std::string_view xml) {
  switch (token.kind) {
    case TokenKind::Text:
    case TokenKind::Attribute: {
      // The blanks before a text are indentation only if the text is in the same line.
      const std::size_t begin = scanner.offset_of(token.value);
      return {begin, begin + token.value.size()};
    }
    case TokenKind::Instruction:
    case TokenKind::Doctype:
      return {token.begin, token.begin + token.value.size()};
    case TokenKind::Fault:
      return {token.begin, xml.size()};
    default:
      return {};
  }
}

bool is_blank_line(std::string_view xml, std::size_t begin) {
  const auto first = std::min(xml.find_first_not_of(" \t\r", begin), xml.size());
  return first == xml.size() || xml[first] == '\n';
}

// Where they begin.
std::vector<std::size_t> movable_lines(std::string_view xml, Grammar grammar) {
  std::vector<std::size_t> lines;
  Scanner scanner(xml, grammar);
  std::size_t at = 0;
  const auto take_until = [&](std::size_t end, bool is_fixed) {
    for (at = xml.find('\n', at); at < end; at = xml.find('\n', at)) {
      if (!is_fixed && !is_blank_line(xml, at + 1)) lines.push_back(at + 1);
      ++at;
    }
    at = end;
  };
  for (bool is_end = false; !is_end;) {
    const XmlToken token = scanner.next();
    is_end = token.kind == TokenKind::End || token.kind == TokenKind::Fault;
    const FixedPart fixed = fixed_part(scanner, token, xml);
    if (fixed.end == 0) continue;
    take_until(fixed.begin, false);
    take_until(fixed.end, true);
  }
  take_until(xml.size(), false);
  return lines;
}

}  // namespace

void shift_lines(TextEdit& edit, std::size_t at, std::string_view xml, Grammar grammar,
                 std::string_view from, std::string_view to) {
  if (from == to) return;
  // The edit has only the bytes that differ.
  const auto same = static_cast<std::size_t>(std::ranges::mismatch(from, to).in1 - from.begin());
  for (const std::size_t line : movable_lines(xml, grammar)) {
    if (!xml.substr(line).starts_with(from)) continue;
    edit.replace(at + line + same, at + line + from.size(), std::string(to.substr(same)));
  }
}

std::string shifted(std::string_view xml, Grammar grammar, std::string_view from,
                    std::string_view to) {
  TextEdit edit;
  shift_lines(edit, 0, xml, grammar, from, to);
  return edit.apply(xml);
}

std::string with_line_ends(std::string_view xml, Grammar grammar, std::string_view line_end) {
  TextEdit edit;
  for (const std::size_t line : movable_lines(xml, grammar)) {
    const std::size_t begin = line > 1 && xml[line - 2] == '\r' ? line - 2 : line - 1;
    edit.replace(begin, line, std::string(line_end));
  }
  return edit.apply(xml);
}

}  // namespace lockstep::host
