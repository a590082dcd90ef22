// The text of runs.csv, a line at a time.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "study/plan.h"
#include "study/results.h"

namespace lockstep {

// What is known of a row only after its run.
struct RowResult {
  std::uint64_t ticks = 0;
  StudyResult result = StudyResult::Success;
  std::vector<double> values;  // of each column; NaN: it is empty
};

// With the end of the line.
std::string row_header(const StudyPlan& plan);

// What a line begins with before anything is run: "cell,<grid>,run,seed,". `cell` is the cell's
// own part: "cell,<grid>,".
std::string row_cell(const StudyPlan& plan, std::uint64_t cell);
void append_row_beginning(const StudyPlan& plan, StudyRow row, const std::string& cell,
                          fmt::memory_buffer& out);
// "ticks,result,<columns>" and the end of the line.
void append_row_end(const RowResult& row, fmt::memory_buffer& out);

// Reads what append_row_end() has written; `row` has as many values as there are columns. False
// when it would have written it in another way.
bool read_row_end(std::string_view text, RowResult& row);

}  // namespace lockstep
