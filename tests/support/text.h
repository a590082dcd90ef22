// Texts in tests.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <string_view>

namespace lockstep::host::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// With `to` in place of the first `from`, which is there.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace lockstep::host::test
