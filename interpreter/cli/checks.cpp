#include "cli/checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

namespace lockstep {

std::string check_count(const std::string& text) {
  const bool good = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return good ? "" : fmt::format("'{}' is not a whole number from 0", text);
}

std::string check_is_number(const std::string& text) {
  double number = 0;
  const bool is_nan = CLI::detail::lexical_cast(text, number) && std::isnan(number);
  return is_nan ? fmt::format("'{}' is not a number", text) : "";
}

}  // namespace lockstep
