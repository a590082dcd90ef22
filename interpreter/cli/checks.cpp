#include "cli/checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lockstep {

std::string check_count(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, number);
  if (text.empty() || rest != end) return fmt::format("'{}' is not a whole number from 0", text);
  if (failure == std::errc()) return "";
  return fmt::format("'{}' is more than {}", text, std::numeric_limits<std::uint64_t>::max());
}

CLI::Validator whole_number(Least least) {
  const auto without_zeros = [least](std::string& text) {
    if (std::string wrong = check_count(text); !wrong.empty()) return wrong;
    text.erase(0, std::min(text.find_first_not_of('0'), text.size() - 1));
    return least == Least::One && text == "0" ? std::string("expected 1 or more") : std::string();
  };
  return {without_zeros, ""};
}

std::string check_is_number(const std::string& text) {
  double number = 0;
  const bool is_nan = CLI::detail::lexical_cast(text, number) && std::isnan(number);
  return is_nan ? fmt::format("'{}' is not a number", text) : "";
}

}  // namespace lockstep
