#include "study/cell_values.h"

#include <cmath>

namespace lockstep::host {

void CellValues::add(const RowResult& row) {
  results_.add(row.result);
  for (std::size_t column = 0; column < values_.size(); ++column) {
    if (!std::isnan(row.values[column])) values_[column].push_back(row.values[column]);
  }
}

void CellValues::clear() {
  for (auto& values : values_) values.clear();
  results_ = {};
}

}  // namespace lockstep::host
