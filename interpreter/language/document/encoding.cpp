#include <fmt/format.h>

#include "base/core/utf8.h"
#include "language/document/well_formed.h"

namespace lockstep::host {
namespace {

constexpr auto kSaveAsUtf8 = "save it as UTF-8";

XmlFault bad_byte(std::string_view text, std::size_t offset) {
  const auto byte = static_cast<unsigned char>(text[offset]);
  if (byte == 0) return {offset, "NUL byte: this is not text in UTF-8", kSaveAsUtf8};
  if (byte < 0x20) return {offset, fmt::format("control character \\x{:02X} in the text", byte)};
  return {offset, fmt::format("byte \\x{:02X} is not UTF-8", byte), kSaveAsUtf8};
}

bool is_allowed_control(char c) {
  return c == '\t' || c == '\n' || c == '\r';
}

constexpr std::size_t kBlock = 32;

// Whether a block is ASCII that is allowed. No branch inside, so that the compiler looks at many
// bytes at once.
bool is_plain(const char* block) {
  signed char other = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const auto c = static_cast<signed char>(block[i]);
    const bool is_other = (c < 0x20) & (c != '\t') & (c != '\n') & (c != '\r');
    other |= static_cast<signed char>(is_other ? -1 : 0);
  }
  return other == 0;
}

}  // namespace

std::optional<XmlFault> check_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  for (const auto mark : {"\xFF\xFE"sv, "\xFE\xFF"sv})
    if (text.starts_with(mark)) return XmlFault{0, "the file is in UTF-16", kSaveAsUtf8};
  for (std::size_t i = 0; i < text.size();) {
    while (text.size() - i >= kBlock && is_plain(text.data() + i)) i += kBlock;
    if (i == text.size()) break;
    if (text[i] >= 0x20 || is_allowed_control(text[i])) {
      ++i;
      continue;
    }
    const auto length =
        static_cast<unsigned char>(text[i]) < 0x20 ? 0 : utf8_length(text.substr(i));
    if (length == 0) return bad_byte(text, i);
    // U+FFFE and U+FFFF.
    if (const auto end = text.substr(i, 3); end == "\xEF\xBF\xBE" || end == "\xEF\xBF\xBF")
      return XmlFault{i, "a character that XML does not allow (U+FFFE or U+FFFF)"};
    i += length;
  }
  return std::nullopt;
}

}  // namespace lockstep::host
