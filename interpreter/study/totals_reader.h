// Reads a cells.jsonl and compares it with its plan, cell by cell.
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "study/cell_totals.h"
#include "study/plan.h"

namespace lockstep::host {

class TotalsReader {
 public:
  // `plan` must outlive the reader.
  TotalsReader(const std::string& path, const StudyPlan& plan);

  // The next cell. None at the end of the file, before a line without its end, or before one that
  // does not match the plan: then error() has the reason.
  std::optional<CellTotals> next();
  const std::string& error() const { return error_; }
  // After the last cell: the error, or that there are not all cells of the plan; else "".
  std::string incomplete() const;
  std::string count_text() const;  // "3 of 10 cells"

  std::uint64_t cells() const { return cells_; }  // so far
  std::uint64_t bytes() const { return bytes_; }  // of them

 private:
  const StudyPlan& plan_;
  std::string path_;
  std::ifstream file_;
  std::string error_;
  std::uint64_t cells_ = 0, bytes_ = 0;
};

}  // namespace lockstep::host
