#include "cli/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"
#include "core/printable_json.h"
#include "observers/text_line.h"
#include "study/column_names.h"

namespace lockstep {
namespace {

using Line = std::vector<std::string>;

Line numbers(const SampleSummary& it) {
  Line line;
  for (const double value : {it.min, it.q1, it.median, it.q3, it.max, it.mean}) {
    line.push_back(fmt::format("{:.6g}", value));
  }
  line.push_back(fmt::format("{}", it.count));
  return line;
}

std::string aligned(const std::vector<Line>& lines, std::size_t names) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      widths[i] = std::max(widths[i], columns(line[i]));
    }
  }
  std::string text;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string blanks(widths[i] - columns(line[i]), ' ');
      if (i != 0) text += "  ";
      text += i < names ? line[i] + blanks : blanks + line[i];
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string summary_table(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  Line head = grid_columns(plan);
  const std::size_t names = head.size() + 2;
  head.insert(head.end(), kSummaryColumns.begin(), kSummaryColumns.end());
  std::vector<Line> lines{head};
  for (const SummaryRow& row : rows) {
    Line line;
    for (const std::string& value : row.grid) line.push_back(printable(value));
    line.push_back(printable(row.node));
    line.push_back(printable(row.measure));
    for (std::string& number : numbers(row.summary)) line.push_back(std::move(number));
    lines.push_back(std::move(line));
  }
  return aligned(lines, names);
}

std::string summary_json(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  using Json = nlohmann::ordered_json;
  Json array = Json::array();
  for (const SummaryRow& row : rows) {
    Json cell = Json::object();
    for (std::size_t i = 0; i < row.grid.size(); ++i) cell[plan.grid[i].name] = row.grid[i];
    const SampleSummary& it = row.summary;
    array.push_back({{"cell", cell},
                     {"node", row.node},
                     {"measure", row.measure},
                     {"min", it.min},
                     {"q1", it.q1},
                     {"median", it.median},
                     {"q3", it.q3},
                     {"max", it.max},
                     {"mean", it.mean},
                     {"n", it.count}});
  }
  return printable_json(array.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lockstep
