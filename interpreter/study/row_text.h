// The text of runs.csv, a line at a time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/plan.h"
#include "study/results.h"

namespace lockstep::host {

// The part of a row that is known only after its run.
struct RowResult {
  std::uint64_t ticks = 0;
  StudyResult result = StudyResult::Success;
  std::vector<double> values;  // of each column; NaN: it is empty
};

// With the end of the line.
std::string row_header(const StudyPlan& plan);

// The beginning of a line, known before the run: "cell,<grid>,run,seed,". `cell` is the part of the
// cell: "cell,<grid>,".
std::string row_cell(const StudyPlan& plan, std::uint64_t cell);
void append_row_beginning(const std::string& cell, std::uint64_t run, std::uint64_t seed,
                          std::string& out);
// "ticks,result,<columns>" and the end of the line.
void append_row_end(const RowResult& row, std::string& out);

// Parses what append_row_end() has written; `row` has a value for each column. Returns false if
// append_row_end() would have written it differently.
bool read_row_end(std::string_view text, RowResult& row);

}  // namespace lockstep::host
