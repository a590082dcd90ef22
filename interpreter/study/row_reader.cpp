#include "study/row_reader.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace lockstep::host {
namespace {

constexpr std::size_t kLongestField = 32;  // of ticks, result and numbers, with the comma

}  // namespace

RowReader::RowReader(const std::string& path, const StudyPlan& plan)
    : plan_(plan),
      rules_(plan),
      path_(path),
      text_(file_.rdbuf()),
      row_{.values = std::vector<double>(plan.columns.size())},
      rows_(plan) {
  if (plan.rows == StudyRows::Zst) text_.rdbuf(&decompressed_.emplace(*file_.rdbuf()));
  std::error_code unknown;
  const auto kind = std::filesystem::status(path, unknown).type();
  if (kind == std::filesystem::file_type::not_found) return;  // no rows yet
  std::string reason = "it is not a regular file";
  if (kind == std::filesystem::file_type::regular) {
    file_.open(path, std::ios::binary);
    if (file_.is_open()) return;
    reason = std::strerror(errno);
  }
  error_ = fmt::format("cannot read '{}': {}", path, reason);
}

std::string RowReader::incomplete() const {
  if (!error_.empty() || !rows_.next()) return error_;
  return fmt::format("'{}' has {}", path_, count_text());
}

std::string RowReader::count_text() const {
  return fmt::format("{} of {}{} runs", rows_.count(), rows_.is_open() ? "at most " : "",
                     rows_.most());
}

// Only a line that has its end. A longer one is read no further.
bool RowReader::read_line(std::size_t longest) {
  line_.resize(longest + 1);
  text_.getline(line_.data(), static_cast<std::streamsize>(line_.size()));
  if (text_.bad()) error_ = fmt::format("'{}' cannot be decompressed", path_);
  if (text_.eof() || text_.gcount() == 0 || text_.bad()) return false;
  line_.resize(static_cast<std::size_t>(text_.gcount()) - (text_.fail() ? 0 : 1));
  if (!text_.fail()) line_ += '\n';
  return true;
}

bool RowReader::read_header() {
  if (bytes_ != 0) return true;
  const std::string header = row_header(plan_);
  if (!read_line(header.size())) return false;
  if (line_ != header) {
    error_ = fmt::format("'{}' begins with other columns than its study.json lists", path_);
    return false;
  }
  bytes_ = line_.size();
  return true;
}

void RowReader::expect_row() {
  beginning_.clear();
  const auto row = rows_.next();
  if (!row) return;
  if (row->cell != cell_) {
    cell_text_ = row_cell(plan_, cell_ = row->cell);
    seed_ = cell_seed(plan_, cell_);
    rules_.enter(cell_);
  }
  append_row_beginning(cell_text_, row->run, run_seed(seed_, seeding_cell(plan_, cell_), row->run),
                       beginning_);
}

bool RowReader::is_expected() {
  return !beginning_.empty() && line_.starts_with(beginning_) &&
         read_row_end(std::string_view(line_).substr(beginning_.size()), row_) &&
         rules_.allow(row_);
}

std::string_view RowReader::next() {
  if (!error_.empty() || !read_header()) return {};
  expect_row();
  const std::size_t longest = beginning_.size() + kLongestField * (2 + row_.values.size());
  if (!read_line(longest)) return {};
  if (!is_expected()) {
    error_ = fmt::format("'{}', line {}: not a row that its study.json has there", path_,
                         rows_.count() + 2);
    return {};
  }
  rows_.add(row_);
  bytes_ += line_.size();
  return line_;
}

}  // namespace lockstep::host
