#include "study/column_names.h"

#include <set>

namespace lockstep::host {

std::vector<std::string> grid_columns(const StudyPlan& plan) {
  std::set<std::string, std::less<>> taken(kRowColumns.begin(), kRowColumns.end());
  taken.insert(kSummaryColumns.begin(), kSummaryColumns.end());
  const auto ours = taken;
  for (const GridAxis& axis : plan.grid) taken.insert(axis.name);
  std::vector<std::string> columns;
  for (const GridAxis& axis : plan.grid) {
    std::string name = axis.name;
    if (ours.contains(name)) {
      do name.insert(0, "grid_");
      while (!taken.insert(name).second);
    }
    columns.push_back(std::move(name));
  }
  return columns;
}

std::string column_name(const StudyColumn& column) {
  return (column.is_gap ? "gap " : "") + column.measure + ' ' + column.node;
}

}  // namespace lockstep::host
