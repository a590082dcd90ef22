// How the runs of a study end, and how many runs of a cell have each result.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "study/intervals.h"
#include "trace/observer.h"

namespace lockstep::host {

// The column 'result' of runs.csv. A fault of a leaf has no row: it ends the study.
enum class StudyResult : std::uint8_t { Success, Failure, Limit };
constexpr std::array<std::string_view, 3> kResultNames{"success", "failure", "limit"};

StudyResult result_of(const RunEnd& end);

struct ResultCounts {
  std::uint64_t runs = 0;
  std::array<std::uint64_t, kResultNames.size()> of = {};  // by StudyResult

  void add(StudyResult result) {
    ++runs;
    ++of[static_cast<std::size_t>(result)];
  }
  double share(std::size_t result) const {
    return static_cast<double>(of[result]) / static_cast<double>(runs);
  }
  Interval interval(std::size_t result) const { return share_interval(of[result], runs); }
};

ResultCounts operator+(ResultCounts one, const ResultCounts& other);

// "20.9 %". "0 %" is exactly none and "100 %" exactly all.
std::string percent(std::uint64_t count, std::uint64_t of);
// "success 79.1 %, failure 20.9 %": those that there are.
std::string to_text(const ResultCounts& results);

}  // namespace lockstep::host
