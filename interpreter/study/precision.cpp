#include "study/precision.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace lockstep::host {
namespace {

bool is_near(const Interval& interval, double value, double width) {
  return interval.high - value <= width && value - interval.low <= width;
}

}  // namespace

std::optional<Precision> precision_from(std::string_view text) {
  Precision precision{.width = 0, .is_percent = text.ends_with('%')};
  const char* const last = text.data() + text.size() - (precision.is_percent ? 1 : 0);
  const auto [end, failure] = std::from_chars(text.data(), last, precision.width);
  const bool good = failure == std::errc() && end == last && std::isfinite(precision.width);
  return good && precision.width > 0 ? std::optional(precision) : std::nullopt;
}

std::string to_text(const Precision& precision) {
  return fmt::format("{}{}", precision.width, precision.is_percent ? "%" : "");
}

bool is_narrow(const Precision& precision, std::string_view measure, const SampleSummary& summary,
               const ResultCounts& results) {
  const double unit = precision.is_percent ? 0.01 : 1;
  if (measure == "success") {
    constexpr auto kSuccess = static_cast<std::size_t>(StudyResult::Success);
    return is_near(results.interval(kSuccess), results.share(kSuccess), precision.width * unit);
  }
  const double of = precision.is_percent ? std::abs(summary.median) : 1;
  return summary.median_interval &&
         is_near(*summary.median_interval, summary.median, precision.width * unit * of);
}

}  // namespace lockstep::host
