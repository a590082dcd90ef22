#include "document/places.h"

#include <algorithm>

#include "document/scanner.h"

namespace lockstep {

Lines::Lines(std::string_view text) : text_(text), starts_{0} {
  for (auto end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1))
    starts_.push_back(end + 1);
}

LineColumn Lines::locate(std::size_t offset) const {
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto column = offset - *(after - 1) + 1;
  return {static_cast<std::uint32_t>(after - starts_.begin()), static_cast<std::uint32_t>(column)};
}

std::string_view Lines::line(std::uint32_t number) const {
  if (number == 0 || number > starts_.size()) return {};
  const auto begin = starts_[number - 1];
  auto line = text_.substr(begin, std::min(text_.find('\n', begin), text_.size()) - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Places::Places(std::string_view text) {
  Scanner scanner(text);
  for (auto token = scanner.next();; token = scanner.next()) {
    if (token.kind == TokenKind::End || token.kind == TokenKind::Fault) return;
    if (token.kind == TokenKind::OpenTag) elements.push_back(token.begin);
    if (token.kind == TokenKind::Attribute) attributes.push_back({token.begin, token.value});
  }
}

}  // namespace lockstep
