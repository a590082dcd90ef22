#include "base/core/utf8.h"

#include <catch2/catch.hpp>
#include <string>

using namespace lockstep::host;

namespace {

// The definition: code points written out, then looked up.
std::string encode(std::uint32_t code) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  const auto tail = [&](int shift, std::uint32_t c) { return byte(0x80 | ((c >> shift) & 0x3F)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), tail(0, code)};
  if (code < 0x10000) return {byte(0xE0 | code >> 12), tail(6, code), tail(0, code)};
  return {byte(0xF0 | code >> 18), tail(12, code), tail(6, code), tail(0, code)};
}

}  // namespace

TEST_CASE("every code point but the surrogates has its length, and no part of it has") {
  std::size_t wrong = 0;
  for (std::uint32_t code = 0; code <= 0x10FFFF; ++code) {
    const auto bytes = encode(code);
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    wrong += utf8_length(bytes + "x") != (surrogate ? 0 : bytes.size());
    wrong += utf8_length(std::string_view(bytes).substr(0, bytes.size() - 1)) != 0;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a character has the code point that it was made from") {
  std::size_t wrong = 0;
  for (std::uint32_t code = 0; code <= 0x10FFFF; ++code) {
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    wrong += first_character(encode(code)).code != (surrogate ? 0 : code);
  }
  CHECK(wrong == 0);
}

TEST_CASE("a terminal needs two columns for a wide character, and none for a mark") {
  CHECK(columns("aé…█│ﬀ") == 6);
  CHECK(columns("抓한カ！😀⌚🫖") == 14);
  CHECK(columns("e\u0301\u200d\ufe0f") == 1);
  CHECK(columns("") == 0);
}

TEST_CASE("terminals obey control characters, line ends and direction marks, nothing else") {
  std::u32string obeyed;
  for (char32_t code = 0; code <= 0x10FFFF; ++code) {
    if (is_obeyed_by_terminals(code) && code >= 0xA0) obeyed += code;
  }
  CHECK(obeyed ==
        U"\u061c\u200e\u200f\u2028\u2029\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069");
  for (char32_t code = 0; code < 0xA0; ++code) {
    CHECK(is_obeyed_by_terminals(code) == (code < ' ' || code >= 0x7F));
  }
}

TEST_CASE("other sequences are not UTF-8") {
  for (const auto* bytes : {"", "\x80", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",
                            "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xe2\x82x"})
    CHECK(utf8_length(bytes) == 0);
}

TEST_CASE("a front part cuts no character") {
  CHECK(utf8_front("a€b", 9) == "a€b");
  CHECK(utf8_front("a€b", 4) == "a€");
  CHECK(utf8_front("a€b", 3) == "a");
  CHECK(utf8_front("a€b", 0).empty());
}
