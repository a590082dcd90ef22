#include "study/row_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/core/csv_field.h"
#include "base/core/wording.h"
#include "study/column_names.h"

namespace lockstep::host {
namespace {

constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();

// The whole field is a number.
template <class Number>
bool read_number(std::string_view field, Number& number) {
  const auto [end, failure] = std::from_chars(field.begin(), field.end(), number);
  return failure == std::errc() && end == field.end();
}

bool read_result(std::string_view field, StudyResult& result) {
  const auto found = std::ranges::find(kResultNames, field);
  if (found == kResultNames.end()) return false;
  result = static_cast<StudyResult>(found - kResultNames.begin());
  return true;
}

}  // namespace

std::string row_header(const StudyPlan& plan) {
  const std::span<const std::string_view> names = kRowColumns;
  std::string header = fmt::format("{},", names.front());
  for (const std::string& name : grid_columns(plan)) header += name + ',';
  header += joined(names.subspan(1), ",");
  for (const StudyColumn& column : plan.columns) {
    header += ',' + csv_field(column_name(column));
  }
  return header + '\n';
}

std::string row_cell(const StudyPlan& plan, std::uint64_t cell) {
  std::string text = fmt::format("{},", cell);
  for (const std::string& value : cell_values(plan, cell)) text += csv_field(value) + ',';
  return text;
}

void append_row_beginning(const std::string& cell, std::uint64_t run, std::uint64_t seed,
                          std::string& out) {
  out += fmt::format("{}{},{},", cell, run, seed);
}

void append_row_end(const RowResult& row, std::string& out) {
  const auto result = kResultNames[static_cast<std::size_t>(row.result)];
  out += fmt::format("{},{}", row.ticks, result);
  for (const double value : row.values) {
    out.push_back(',');
    if (!std::isnan(value)) append_text(value, out);
  }
  out.push_back('\n');
}

bool read_row_end(std::string_view text, RowResult& row) {
  std::string_view left = text;
  const auto take = [&](char separator) {
    const auto end = std::min(left.find(separator), left.size());
    const std::string_view field = left.substr(0, end);
    left.remove_prefix(std::min(end + 1, left.size()));
    return field;
  };
  if (!read_number(take(','), row.ticks)) return false;
  const bool last = row.values.empty();
  if (!read_result(take(last ? '\n' : ','), row.result)) return false;
  for (double& value : row.values) {
    const std::string_view field = take(&value == &row.values.back() ? '\n' : ',');
    value = kEmpty;
    if (!field.empty() && !read_number(field, value)) return false;
  }
  // Numbers that could be written in other ways, missing ends of lines, further fields.
  std::string again;
  append_row_end(row, again);
  return text == again;
}

}  // namespace lockstep::host
