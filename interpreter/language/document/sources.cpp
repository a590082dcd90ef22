#include "language/document/sources.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/utf8.h"
#include "language/document/byte_order_mark.h"
#include "language/document/references.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kExcerptBytes = 200;

}  // namespace

Source::Source(std::string path, std::string text, Place first)
    : path_(std::move(path)), text_(std::move(text)), first_(first) {
  text_.erase(0, byte_order_mark(text_).size());
}

const LineIndex& Source::lines() const {
  std::call_once(counted_, [this] { lines_.emplace(text_); });
  return *lines_;
}

SourceLocation Source::at(std::size_t offset) const {
  const auto [line, column] = lines().locate(offset);
  return {path_, line, column};
}

SourceLocation Source::locate(Place place) const {
  return at(place.byte - first_.byte);
}

SourceLocation Source::locate_value(Place attribute, std::size_t byte) const {
  const std::size_t place = attribute.byte - first_.byte;
  if (text_[place] == '<') return at(place);  // an element, which leaves the attribute out
  if (place > 0 && (text_[place - 1] == '>' || text_[place - 1] == '[')) {  // it is a text
    return at(place + raw_offset(text().substr(place), byte));
  }
  const auto open = text_.find_first_of("\"'", place);
  const auto begin = open + 1;
  const auto raw = text().substr(begin, text_.find(text_[open], begin) - begin);
  return at(begin + raw_offset(raw, byte));
}

Excerpt Source::excerpt(std::uint32_t line, std::uint32_t column) const {
  std::string_view text = lines().line(line);
  // A place within the first part needs nothing before it to be left out.
  constexpr std::size_t kBefore = 100;
  std::size_t begin = 0;
  if (text.size() > kExcerptBytes && column > kExcerptBytes - kBefore / 2) {
    begin = std::min<std::size_t>(column - 1, text.size()) - kBefore;
    while (begin > 0 && (static_cast<unsigned char>(text[begin]) & 0xC0u) == 0x80) --begin;
  }
  text.remove_prefix(begin);
  return {std::string(utf8_front(text, kExcerptBytes)), static_cast<std::uint32_t>(begin + 1)};
}

const Source& Sources::of(Place place) const {
  const auto after = std::ranges::upper_bound(
      all_, place.byte, {}, [](const auto& source) { return source->place_of(0).byte; });
  return **std::prev(after);
}

std::string to_text(const SourceLocation& location) {
  return fmt::format("{}:{}:{}", location.file, location.line, location.column);
}

}  // namespace lockstep::host
