// Reads a runs.csv, or runs.csv.zst if its plan says so, and compares it with its plan, line by
// line: to resume a study, to merge parts, and for the summary.
#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "base/compression/decompressed.h"
#include "study/row_rules.h"
#include "study/row_sequence.h"
#include "study/row_text.h"

namespace lockstep::host {

class RowReader {
 public:
  // `plan` must outlive the reader.
  RowReader(const std::string& path, const StudyPlan& plan);

  // The next line, with its line end. "" at the end of the file, before a cut last line, or before
  // a line that does not match the plan: then error() has the reason.
  std::string_view next();
  // The content of the line that next() gave.
  const RowResult& row() const { return row_; }
  std::uint64_t cell() const { return cell_; }

  const std::string& error() const { return error_; }
  // After the last line: the error, or that there are not all rows of the plan; else "".
  std::string incomplete() const;
  const RowSequence& rows() const { return rows_; }  // so far
  std::string count_text() const;                    // of them: "3 of 10 runs"
  std::uint64_t bytes() const { return bytes_; }     // of them and the header

 private:
  bool read_line(std::size_t longest);
  bool read_header();
  bool is_expected();
  void expect_row();

  const StudyPlan& plan_;
  RowRules rules_;
  std::string path_;
  std::ifstream file_;
  std::optional<Decompressed> decompressed_;
  std::istream text_;
  std::string line_;
  std::uint64_t cell_ = ~std::uint64_t{0};
  std::string cell_text_;
  std::uint64_t seed_ = 0;  // of the cell
  std::string beginning_;   // of the line that comes next
  RowResult row_;
  std::string error_;
  RowSequence rows_;
  std::uint64_t bytes_ = 0;
};

}  // namespace lockstep::host
