#include "cli/checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

std::string check_whole(const std::string& text, std::uint64_t least, std::uint64_t most) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, number);
  const bool is_whole = !text.empty() && rest == end;
  const bool fits = failure == std::errc();
  if (is_whole && fits && number >= least && number <= most) return "";
  if (is_whole && most == kMost && !fits) {
    return fmt::format("'{}' is more than {}", brief(text), most);
  }
  return fmt::format("'{}' is not a whole number from {}{}", brief(text), least,
                     most == kMost ? "" : fmt::format(" to {}", most));
}

}  // namespace

std::string check_count(const std::string& text) {
  return check_whole(text, 0, kMost);
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const auto without_zeros = [=](std::string& text) {
    std::string wrong = check_whole(text, least, most);
    if (wrong.empty()) text.erase(0, std::min(text.find_first_not_of('0'), text.size() - 1));
    return wrong;
  };
  return {without_zeros, ""};
}

CLI::Validator number_between(double least, double most) {
  const auto check = [=](std::string& text) -> std::string {
    double value = 0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    if (is_number && value >= least && value <= most) return "";
    return fmt::format("'{}' is not a number from {} to {}", brief(text), least, most);
  };
  return {check, ""};
}

CLI::Validator one_of(const std::vector<std::string>& words, FormerWord former) {
  const auto check = [words, former](std::string& text) -> std::string {
    if (std::ranges::find(words, text) != words.end()) return "";
    if (text == former.word && !text.empty()) {
      return fmt::format("'{}' is no longer written: {}", text, former.instead);
    }
    const std::vector<std::string_view> candidates(words.begin(), words.end());
    const std::string near = did_you_mean(text, candidates);
    return fmt::format("'{}' is not one of {}{}{}", brief(text), joined(words, ", "),
                       near.empty() ? "" : "; ", near);
  };
  return {check, joined(words, "|")};
}

}  // namespace lockstep::host
