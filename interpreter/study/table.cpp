#include "study/table.h"

#include <fmt/format.h>

#include <iterator>

#include "base/core/csv_field.h"
#include "base/core/wording.h"
#include "study/cell_values.h"
#include "study/column_names.h"
#include "study/row_reader.h"
#include "study/totals_reader.h"

namespace lockstep::host {
namespace {

// `values` is a CellValues or a CellTotals.
template <class Values>
void append_rows(const StudyPlan& plan, std::uint64_t cell, const Values& values,
                 std::vector<SummaryRow>& rows) {
  for (std::size_t column = 0; column < plan.columns.size(); ++column) {
    const StudyColumn& it = plan.columns[column];
    if (!has_column(it, cell)) continue;
    const SampleSummary summary = values.summary(column);
    if (!it.is_gap) {
      rows.push_back({cell_values(plan, cell), it.node, it.measure, summary, values.results(), {}});
    } else if (summary.count > 0) {
      rows.back().gap = summary.median;
    }
  }
}

Result<std::vector<SummaryRow>> summarize_runs(const std::string& path, const StudyPlan& plan) {
  RowReader reader(path, plan);
  CellValues values(plan);
  std::vector<SummaryRow> rows;
  std::uint64_t cell = 0;
  while (!reader.next().empty()) {
    if (reader.cell() != cell) {
      append_rows(plan, cell, values, rows);
      values.clear();
    }
    cell = reader.cell();
    values.add(reader.row());
  }
  append_rows(plan, cell, values, rows);
  if (auto error = reader.incomplete(); !error.empty()) return problem(std::move(error));
  return rows;
}

Result<std::vector<SummaryRow>> summarize_totals(const std::string& path, const StudyPlan& plan) {
  TotalsReader reader(path, plan);
  std::vector<SummaryRow> rows;
  while (const auto totals = reader.next()) append_rows(plan, reader.cells() - 1, *totals, rows);
  if (auto error = reader.incomplete(); !error.empty()) return problem(std::move(error));
  return rows;
}

std::string optional_field(const std::optional<double>& value) {
  return value ? fmt::format(",{}", *value) : ",";
}

}  // namespace

std::array<std::optional<double>, kIntervalColumns.size()> SummaryRow::intervals() const {
  std::array<std::optional<double>, kIntervalColumns.size()> ends;
  if (summary.median_interval) {
    ends[0] = summary.median_interval->low;
    ends[1] = summary.median_interval->high;
  }
  for (std::size_t i = 0; i < kResultNames.size(); ++i) {
    const Interval interval = results.interval(i);
    ends[2 * i + 2] = interval.low;
    ends[2 * i + 3] = interval.high;
  }
  return ends;
}

Result<std::vector<SummaryRow>> summarize_study(const std::string& path, const StudyPlan& plan) {
  return plan.rows == StudyRows::None ? summarize_totals(path, plan) : summarize_runs(path, plan);
}

std::string summary_csv(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  std::string text;
  for (const std::string& name : grid_columns(plan)) text += name + ',';
  text += fmt::format("{},{}\n", joined(kSummaryColumns, ","), joined(kIntervalColumns, ","));
  for (const SummaryRow& row : rows) {
    for (const std::string& value : row.grid) text += csv_field(value) + ',';
    const SampleSummary& it = row.summary;
    text += csv_field(row.node) + ',' + csv_field(row.measure);
    for (const double value : {it.min, it.q1, it.median, it.q3, it.max, it.mean}) {
      text += it.count == 0 ? "," : fmt::format(",{}", value);
    }
    text += fmt::format(",{},{}", it.count, row.results.runs);
    for (std::size_t i = 0; i < kResultNames.size(); ++i) {
      text += fmt::format(",{}", row.results.share(i));
    }
    text += optional_field(row.gap);
    for (const auto& end : row.intervals()) text += optional_field(end);
    text += '\n';
  }
  return text;
}

}  // namespace lockstep::host
