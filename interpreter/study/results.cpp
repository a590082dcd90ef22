#include "study/results.h"

#include <fmt/format.h>

namespace lockstep::host {

StudyResult result_of(const RunEnd& end) {
  if (end.reason != StopReason::Completed) return StudyResult::Limit;
  return end.status == Status::Success ? StudyResult::Success : StudyResult::Failure;
}

ResultCounts operator+(ResultCounts one, const ResultCounts& other) {
  one.runs += other.runs;
  for (std::size_t result = 0; result < one.of.size(); ++result) one.of[result] += other.of[result];
  return one;
}

std::string percent(std::uint64_t count, std::uint64_t of) {
  if (count == 0) return "0 %";
  if (count == of) return "100 %";
  const double share = 100 * static_cast<double>(count) / static_cast<double>(of);
  if (share < 0.1) return "<0.1 %";
  if (share > 99.9) return ">99.9 %";
  return fmt::format("{:.3g} %", share);
}

std::string to_text(const ResultCounts& results) {
  std::string text;
  for (std::size_t result = 0; result < kResultNames.size(); ++result) {
    if (results.of[result] == 0) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}", kResultNames[result], percent(results.of[result], results.runs));
  }
  return text;
}

}  // namespace lockstep::host
