#include "study/row_text.h"

#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>

#include "observers/recording_csv.h"
#include "study/column_names.h"

namespace lockstep {
namespace {

std::string_view result_of(const RunEnd& end) {
  return end.reason == StopReason::Completed ? to_string(end.status) : "limit";
}

}  // namespace

std::string row_header(const StudyPlan& plan) {
  const std::span<const std::string_view> names = kRowColumns;
  std::string header = fmt::format("{},", names.front());
  for (const std::string& name : grid_columns(plan)) header += name + ',';
  header += fmt::format("{}", fmt::join(names.subspan(1), ","));
  for (const StudyColumn& column : plan.columns) {
    header += ',' + csv_field(column.measure + ' ' + column.node);
  }
  return header + '\n';
}

std::string row_cell(const StudyPlan& plan, std::uint64_t cell) {
  std::string text = fmt::format("{},", cell);
  for (const std::string& value : cell_values(plan, cell)) text += csv_field(value) + ',';
  return text;
}

void append_row_beginning(const StudyPlan& plan, StudyRow row, const std::string& cell,
                          fmt::memory_buffer& out) {
  fmt::format_to(std::back_inserter(out), "{}{},{},", cell, row.run, run_seed(plan, row));
}

void append_row_end(const RunEnd& end, std::span<const double> values, fmt::memory_buffer& out) {
  fmt::format_to(std::back_inserter(out), "{},{}", end.ticks, result_of(end));
  for (const double value : values) {
    out.push_back(',');
    if (!std::isnan(value)) fmt::format_to(std::back_inserter(out), "{}", value);
  }
  out.push_back('\n');
}

bool read_row_values(std::string_view end_of_line, std::vector<double>& values) {
  const auto take = [&](char separator) {
    const auto end = end_of_line.find(separator);
    const std::string_view field = end_of_line.substr(0, end);
    end_of_line.remove_prefix(end == std::string_view::npos ? end_of_line.size() : end + 1);
    return field;
  };
  if (!end_of_line.ends_with('\n')) return false;
  end_of_line.remove_suffix(1);
  take(',');  // ticks
  take(',');  // result
  for (double& value : values) {
    const std::string_view field = take(',');
    value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, failure] = std::from_chars(field.begin(), field.end(), value);
    if (!field.empty() && (failure != std::errc() || end != field.end())) return false;
  }
  return end_of_line.empty();
}

}  // namespace lockstep
