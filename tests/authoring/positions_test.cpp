// Positions in a text are those of a count from the beginning of each line, however long it is.
#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "author/server/positions.h"

namespace lockstep::host::test {
namespace {

std::string some_text(std::mt19937& random) {
  const std::string pieces[] = {"a", "<Wait/>", "\u00fc", "\U0001F600", "\u20ac"};
  const std::string ends[] = {"\n", "\r\n", "\r"};
  std::string text;
  for (unsigned line = random() % 4 + 1; line > 0; --line) {
    const std::size_t size = random() % 2 == 0 ? random() % 5000 : random() % 600;
    const std::size_t begin = text.size();
    while (text.size() < begin + size) text += pieces[random() % std::size(pieces)];
    if (line > 1) text += ends[random() % std::size(ends)];
  }
  return text;
}

// Slow and obvious.
Position counted(const std::string& text, std::size_t byte) {
  Position at;
  for (std::size_t i = 0; i < byte; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool ends = c == '\n' || (c == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
    if (ends) {
      at = {at.line + 1, 0};
    } else if ((c & 0xC0u) != 0x80) {
      at.character += c >= 0xF0 ? 2 : 1;
    }
  }
  return at;
}

bool begins_character(const std::string& text, std::size_t byte) {
  return byte == text.size() || (static_cast<unsigned char>(text[byte]) & 0xC0u) != 0x80;
}

}  // namespace

TEST_CASE("positions: bytes and UTF-16 units of lines of any length") {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    const std::string text = some_text(random);
    const Positions positions(text);
    for (int look = 0; look < 100; ++look) {
      const std::size_t byte = random() % (text.size() + 1);
      const bool is_within_end =
          byte > 0 && byte < text.size() && text[byte - 1] == '\r' && text[byte] == '\n';
      if (!begins_character(text, byte) || is_within_end) continue;
      const Position at = positions.position_of(byte);
      CHECK(at == counted(text, byte));
      CHECK(positions.byte_at(at) == byte);
    }
    CHECK(positions.byte_at({0, UINT64_MAX}) <= text.size());
    CHECK(positions.byte_at({99, 0}) == text.size());
  }
}

}  // namespace lockstep::host::test
