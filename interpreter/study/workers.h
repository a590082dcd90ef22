// The threads of a study. They take chunks of rows, in order, by incrementing one atomic number,
// without a lock. The results come out in the order of the rows, whatever the number of threads.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "study/row_text.h"
#include "study/study_run.h"

namespace lockstep::host {

// A leaf failed as a program, in this run.
struct StudyFault {
  StudyRow row;
  std::uint64_t seed = 0;
  Fault fault;
  std::uint64_t ticks = 0;  // of the run; 0: before the first
};

// A leaf reported a progress outside [0, 1] in this run.
struct StudyOutOfRange {
  StudyRow row;
  OutOfRange progress;
};

struct StudyWork {
  const StudyPlan& plan;
  std::span<const StudyCell> cells;
  std::span<const MeasureSpec> measures;
  std::uint64_t first_row = 0, last_row = 0;  // the last is not included
  unsigned jobs = 1;
  Nanoseconds hang_limit{0};  // a call of a leaf that lasts longer ends the process; 0 = never
  int (*stop_signal)() = nullptr;
  // Called on the caller's thread with lines of runs.csv, in order, and what is in them; false ends
  // the work.
  std::function<bool(std::string_view lines, std::span<const RowResult> rows)> write;
  // As write, after it: of those rows.
  std::function<void(const StudyOutOfRange&)> out_of_range;
  // Called now and then, after writing.
  std::function<void()> idle;
};

// Runs until these rows are made, a leaf has a fault or a signal comes. The fault is the first in
// the order of the rows; all rows before it are written. They are also written if this rethrows an
// exception of a thread.
std::optional<StudyFault> do_work(const StudyWork& work);

}  // namespace lockstep::host
