// The header of Catch2 2, which the tests include, for Catch2 3.
#pragma once

#include <catch2/catch_all.hpp>
#include <string>

namespace Catch {

inline auto Contains(const std::string& text) {
  return Matchers::ContainsSubstring(text);
}
using Matchers::EndsWith;

}  // namespace Catch

using Catch::Approx;
