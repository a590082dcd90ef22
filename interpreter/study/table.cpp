#include "study/table.h"

#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "observers/recording_csv.h"
#include "study/column_names.h"
#include "study/row_reader.h"

namespace lockstep {
namespace {

// The values of one cell, by column.
class CellValues {
 public:
  explicit CellValues(std::size_t columns) : values_(columns) {}

  void add(const std::vector<double>& row) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      if (!std::isnan(row[column])) values_[column].push_back(row[column]);
    }
  }

  void finish(const StudyPlan& plan, std::uint64_t cell, std::vector<SummaryRow>& rows) {
    for (std::size_t column = 0; column < values_.size(); ++column) {
      if (values_[column].empty()) continue;
      rows.push_back({cell_values(plan, cell), plan.columns[column].node,
                      plan.columns[column].measure, summarize(std::move(values_[column]))});
      values_[column].clear();
    }
  }

 private:
  std::vector<std::vector<double>> values_;
};

}  // namespace

std::vector<SummaryRow> summarize_runs(const std::string& path, const StudyPlan& plan,
                                       std::string& error) {
  RowReader reader(path, plan);
  CellValues values(plan.columns.size());
  std::vector<SummaryRow> rows;
  std::uint64_t cell = 0;
  while (!reader.next().empty()) {
    const std::uint64_t current = row_at(plan, reader.rows() - 1).cell;
    if (current != cell) values.finish(plan, cell, rows);
    cell = current;
    values.add(reader.row().values);
  }
  values.finish(plan, cell, rows);
  error = reader.error();
  if (error.empty() && reader.rows() != row_count(plan)) {
    error = fmt::format("'{}' has {} of {} runs", path, reader.rows(), row_count(plan));
  }
  return rows;
}

std::string summary_csv(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  std::string text;
  for (const std::string& name : grid_columns(plan)) text += name + ',';
  text += fmt::format("{}\n", fmt::join(kSummaryColumns, ","));
  for (const SummaryRow& row : rows) {
    for (const std::string& value : row.grid) text += csv_field(value) + ',';
    const SampleSummary& it = row.summary;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}\n", csv_field(row.node),
                   csv_field(row.measure), it.min, it.q1, it.median, it.q3, it.max, it.mean,
                   it.count);
  }
  return text;
}

}  // namespace lockstep
