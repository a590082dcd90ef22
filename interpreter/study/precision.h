// `--until-ci`: when the 95 % intervals of a cell are narrow enough.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "study/plan.h"
#include "study/results.h"
#include "study/sample_summary.h"

namespace lockstep::host {

// "5%", of the value; "0.5", in the unit of the measure. Nothing if it is neither.
std::optional<Precision> precision_from(std::string_view text);
// As precision_from reads it.
std::string to_text(const Precision& precision);

// Whether neither end of the interval is farther from its value: from the median, and of the
// measure `success` from the share, where percent are percentage points. False without an interval.
bool is_narrow(const Precision& precision, std::string_view measure, const SampleSummary& summary,
               const ResultCounts& results);

// After how many runs the intervals of a cell are looked at next. There are few looks: with each of
// them, an interval that is narrow by chance becomes more likely.
constexpr std::uint64_t next_look(std::uint64_t runs) {
  return runs == 0 ? 100 : runs + runs / 4;
}

}  // namespace lockstep::host
