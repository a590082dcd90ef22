#include "study/table.h"

#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "core/csv_field.h"
#include "study/column_names.h"
#include "study/row_reader.h"

namespace lockstep {
namespace {

// The rows of one cell, taken apart by column.
class CellValues {
 public:
  explicit CellValues(const StudyPlan& plan) : plan_(plan), values_(plan.columns.size()) {}

  void add(const RowResult& row) {
    results_.add(row.result);
    for (std::size_t column = 0; column < values_.size(); ++column) {
      if (!std::isnan(row.values[column])) values_[column].push_back(row.values[column]);
    }
  }

  void finish(std::uint64_t cell, std::vector<SummaryRow>& rows) {
    for (std::size_t column = 0; column < values_.size(); ++column) {
      const StudyColumn& it = plan_.columns[column];
      if (!has_column(it, cell)) continue;
      const SampleSummary summary = summarize(std::move(values_[column]));
      values_[column].clear();
      if (!it.is_gap) {
        rows.push_back({cell_values(plan_, cell), it.node, it.measure, summary, results_, {}});
      } else if (summary.count > 0) {
        rows.back().gap = summary.median;
      }
    }
    results_ = {};
  }

 private:
  const StudyPlan& plan_;
  std::vector<std::vector<double>> values_;
  ResultCounts results_;
};

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

Result<std::vector<SummaryRow>> summarize_runs(const std::string& path, const StudyPlan& plan) {
  RowReader reader(path, plan);
  CellValues values(plan);
  std::vector<SummaryRow> rows;
  std::uint64_t cell = 0;
  while (!reader.next().empty()) {
    const std::uint64_t current = row_at(plan, reader.rows() - 1).cell;
    if (current != cell) values.finish(cell, rows);
    cell = current;
    values.add(reader.row());
  }
  values.finish(cell, rows);
  if (auto error = reader.incomplete(); !error.empty())
    return tl::unexpected(Problem{std::move(error)});
  return rows;
}

std::string summary_csv(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  std::string text;
  for (const std::string& name : grid_columns(plan)) text += name + ',';
  text += fmt::format("{},{}\n", fmt::join(kSummaryColumns, ","), fmt::join(kIntervalColumns, ","));
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

}  // namespace lockstep
