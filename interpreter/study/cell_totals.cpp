#include "study/cell_totals.h"

#include <cmath>

namespace lockstep::host {

void CellTotals::add(const RowResult& row) {
  results_.add(row.result);
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const double value = row.values[column];
    if (std::isnan(value)) continue;
    columns_[column].sum.add(value);
    columns_[column].values.add(value);
  }
}

void CellTotals::add(const CellTotals& other) {
  results_ = results_ + other.results_;
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    columns_[column].sum.add(other.columns_[column].sum);
    columns_[column].values.add(other.columns_[column].values);
  }
}

SampleSummary CellTotals::summary(std::size_t column) const {
  const auto& [sum, values] = columns_[column];
  return summarize(values, sum);
}

}  // namespace lockstep::host
