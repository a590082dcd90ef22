#include "base/core/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMaxName = 256;  // bytes, so no more letters
constexpr std::size_t kMaxListed = 10;
constexpr std::size_t kMaxListBytes = 256;
constexpr std::size_t kMaxLinks = 10;
constexpr std::string_view kEllipsis = "…";

}  // namespace

std::string brief(std::string_view name) {
  if (name.size() <= kMaxName) return std::string(name);
  return std::string(utf8_front(name, kMaxName - kEllipsis.size())).append(kEllipsis);
}

std::string listed(std::span<const std::string_view> names) {
  std::string list;
  std::size_t count = 0;
  for (; count < names.size() && count < kMaxListed && list.size() < kMaxListBytes; ++count) {
    list += fmt::format("{}'{}'", count == 0 ? "" : ", ", brief(names[count]));
  }
  if (count < names.size()) list += fmt::format(" and {} more", names.size() - count);
  return list;
}

std::string chained(std::span<const std::string_view> names) {
  const std::size_t left_out = names.size() > kMaxLinks ? names.size() - kMaxLinks : 0;
  const std::size_t gap = kMaxLinks / 2;  // where they are left out
  std::string chain;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) chain += " -> ";
    if (left_out > 0 && i == gap) {
      chain += fmt::format("{} ({} more) {} -> ", kEllipsis, left_out, kEllipsis);
      i += left_out;
    }
    chain += brief(names[i]);
  }
  return chain;
}

std::string arity_text(std::uint32_t least, std::uint32_t most) {
  if (most == 1) return "exactly one child";
  if (least == most) return fmt::format("exactly {} children", most);
  if (most != std::numeric_limits<std::uint32_t>::max()) {
    return fmt::format("{} to {} children", least, most);
  }
  return least <= 1 ? "one or more children" : fmt::format("{} or more children", least);
}

std::string duration_text(Nanoseconds time) {
  const double seconds = to_seconds(std::max(time, Nanoseconds(0)));
  return seconds < 3 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.0f} s", seconds);
}

std::string rounded(double value) {
  constexpr int kDigits = 4;
  if (!std::isfinite(value) || value == 0) return fmt::format("{}", value);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  if (before > kDigits && before <= 15) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, kDigits);
}

std::string rounded_within(double value, double range) {
  constexpr int kDigits = 3, kMostDecimals = 12;
  if (!(range > 0) || !std::isfinite(range) || !std::isfinite(value)) {
    return fmt::format("{:.6g}", value);
  }
  const int places = kDigits - 1 - static_cast<int>(std::floor(std::log10(range)));
  const std::string text = fmt::format("{:.{}f}", value, std::clamp(places, 0, kMostDecimals));
  const std::string exact = fmt::format("{:.10g}", value);
  if (exact.size() < text.size()) return exact;
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text[0] == '-' ? text.substr(1) : text;
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace lockstep::host
