#include "cli/run/rotation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/core/value.h"

namespace lockstep::host {
namespace {

struct Unit {
  std::string_view name;
  double bytes, seconds;
};
constexpr Unit kUnits[] = {
    {"kB", 1e3, 0},   {"MB", 1e6, 0},          {"GB", 1e9, 0},
    {"KiB", 1024, 0}, {"MiB", 1024 * 1024, 0}, {"GiB", 1024. * 1024 * 1024, 0},
    {"s", 0, 1},      {"min", 0, 60},          {"h", 0, 3600},
};
constexpr double kLeastBytes = 1e3, kLeastSeconds = 0.1, kMostBytes = 1e15, kMostSeconds = 1e8;

}  // namespace

std::optional<Rotation> rotation_from(std::string_view text) {
  const auto end = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto number = parse_double(text.substr(0, end));
  const auto unit = std::ranges::find(kUnits, text.substr(end), &Unit::name);
  if (!number || unit == std::end(kUnits)) return std::nullopt;
  const double bytes = *number * unit->bytes, seconds = *number * unit->seconds;
  const bool is_enough = bytes >= kLeastBytes || seconds >= kLeastSeconds;
  if (!is_enough || !(bytes <= kMostBytes) || !(seconds <= kMostSeconds)) return std::nullopt;
  return Rotation{.bytes = static_cast<std::uint64_t>(bytes), .time = from_seconds(seconds)};
}

}  // namespace lockstep::host
