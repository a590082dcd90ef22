// The text of runs.csv, a line at a time.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "runtime/observer.h"
#include "study/plan.h"

namespace lockstep {

// With the end of the line.
std::string row_header(const StudyPlan& plan);

// What a line begins with before anything is run: "cell,<grid>,run,seed,". `cell` is the cell's
// own part: "cell,<grid>,".
std::string row_cell(const StudyPlan& plan, std::uint64_t cell);
void append_row_beginning(const StudyPlan& plan, StudyRow row, const std::string& cell,
                          fmt::memory_buffer& out);
// "ticks,result,<columns>" and the end of the line. A value that is NaN is an empty field.
void append_row_end(const RunEnd& end, std::span<const double> values, fmt::memory_buffer& out);

// The numbers of the columns in a whole line; false when the line has others, or other ends.
bool read_row_values(std::string_view end_of_line, std::vector<double>& values);

}  // namespace lockstep
