#include "study/row_reader.h"

namespace lockstep {

RowReader::RowReader(const std::string& path, const StudyPlan& plan)
    : plan_(plan), path_(path), file_(path, std::ios::binary), values_(plan.columns.size()) {}

// Only a line that has its end.
bool RowReader::read_line() {
  if (!std::getline(file_, line_) || file_.eof()) return false;
  line_ += '\n';
  return true;
}

bool RowReader::read_header() {
  if (bytes_ != 0) return true;
  if (!read_line()) return false;
  if (line_ != row_header(plan_)) {
    error_ = fmt::format("'{}' begins with other columns than its study.json says", path_);
    return false;
  }
  bytes_ = line_.size();
  return true;
}

bool RowReader::is_expected() {
  if (rows_ == row_count(plan_)) return false;
  const StudyRow row = row_at(plan_, rows_);
  if (row.cell != cell_) cell_text_ = row_cell(plan_, cell_ = row.cell);
  beginning_.clear();
  append_row_beginning(plan_, row, cell_text_, beginning_);
  const std::string_view beginning(beginning_.data(), beginning_.size());
  return line_.starts_with(beginning) &&
         read_row_values(std::string_view(line_).substr(beginning.size()), values_);
}

std::string_view RowReader::next() {
  if (!error_.empty() || !read_header() || !read_line()) return {};
  if (!is_expected()) {
    error_ =
        fmt::format("'{}', line {}: not the row that its study.json has there", path_, rows_ + 2);
    return {};
  }
  ++rows_;
  bytes_ += line_.size();
  return line_;
}

}  // namespace lockstep
