#include "cli/tools/study/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "study/column_names.h"
#include "study/precision.h"

namespace lockstep::host {
namespace {

constexpr char kNone[] = "-";

using Rows = std::vector<const SummaryRow*>;

std::string interval_text(const std::string& low, const std::string& high) {
  return fmt::format("[{}, {}]", low, high);
}

TableRow line_of(const SummaryRow& row) {
  TableRow line;
  for (const std::string& value : row.grid) line.push_back(printable(value));
  return line;
}

void append_numbers(const SummaryRow& row, TableRow& line) {
  const SampleSummary& it = row.summary;
  const auto text_of = [&](double value) {
    return it.count == 0 ? std::string(kNone) : rounded_within(value, it.max - it.min);
  };
  for (const double value : {it.min, it.q1, it.median}) line.push_back(text_of(value));
  const auto& interval = it.median_interval;
  line.push_back(interval ? interval_text(text_of(interval->low), text_of(interval->high)) : kNone);
  for (const double value : {it.q3, it.max, it.mean}) line.push_back(text_of(value));
  line.push_back(fmt::format("{}", it.count));
  if (row.gap) line.push_back(fmt::format("{:.3g}{}", *row.gap, row.is_far() ? " !" : "  "));
}

// A measure in each cell.
std::string measure_table(const StudyPlan& plan, const Rows& rows, std::size_t width) {
  TableRow head = grid_columns(plan);
  for (const char* name : {"min", "q1", "median", "95 % of median", "q3", "max", "mean", "n"}) {
    head.emplace_back(name);
  }
  const auto has_gap = [](const SummaryRow* row) { return row->gap.has_value(); };
  if (std::ranges::any_of(rows, has_gap)) head.emplace_back("gap");
  std::vector<TableRow> lines{head};
  for (const SummaryRow* row : rows) {
    lines.push_back(line_of(*row));
    append_numbers(*row, lines.back());
  }
  return text_table(lines, plan.grid.size(), width);
}

// How the runs of each cell ended.
std::string result_table(const StudyPlan& plan, const Rows& rows, std::size_t width) {
  TableRow head = grid_columns(plan);
  head.emplace_back("runs");
  for (const std::string_view name : kResultNames) {
    head.emplace_back(name);
    head.emplace_back("95 %");
  }
  std::vector<TableRow> lines{head};
  for (const SummaryRow* row : rows) {
    TableRow line = line_of(*row);
    const ResultCounts& results = row->results;
    line.push_back(fmt::format("{}", results.runs));
    for (std::size_t i = 0; i < kResultNames.size(); ++i) {
      const Interval it = results.interval(i);
      line.push_back(percent(results.of[i], results.runs));
      line.push_back(
          interval_text(fmt::format("{:.3g}", it.low * 100), fmt::format("{:.3g}", it.high * 100)));
    }
    lines.push_back(std::move(line));
  }
  return text_table(lines, plan.grid.size(), width);
}

}  // namespace

std::string summary_table(const StudyPlan& plan, const std::vector<SummaryRow>& rows,
                          std::size_t width) {
  std::vector<std::pair<std::string, Rows>> measures;  // in the order of the first cell
  Rows cells;                                          // one row of each
  for (const SummaryRow& row : rows) {
    const std::string title = printable(fmt::format("{} of {}", row.measure, row.node));
    auto found = std::ranges::find(measures, title, &std::pair<std::string, Rows>::first);
    if (found == measures.end()) found = measures.insert(found, {title, {}});
    found->second.push_back(&row);
    if (cells.empty() || cells.back()->grid != row.grid) cells.push_back(&row);
  }
  std::string text;
  for (const auto& [title, of_cells] : measures) {
    text += title + "\n" + measure_table(plan, of_cells, width) + "\n";
  }
  return text + "results\n" + result_table(plan, cells, width);
}

std::string summary_json(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  Json array = Json::array();
  for (const SummaryRow& row : rows) {
    Json cell = Json::object();
    for (std::size_t i = 0; i < row.grid.size(); ++i) cell[plan.grid[i].name] = row.grid[i];
    Json json{{"cell", cell}, {"node", row.node}, {"measure", row.measure}};
    const SampleSummary& it = row.summary;
    const std::pair<const char*, double> numbers[] = {{"min", it.min},       {"q1", it.q1},
                                                      {"median", it.median}, {"q3", it.q3},
                                                      {"max", it.max},       {"mean", it.mean}};
    for (const auto& [name, value] : numbers) json[name] = it.count == 0 ? Json() : Json(value);
    json["n"] = it.count;
    json["runs"] = row.results.runs;
    for (std::size_t i = 0; i < kResultNames.size(); ++i) {
      json[kResultNames[i]] = row.results.share(i);
    }
    json["gap"] = row.gap;
    const auto ends = row.intervals();
    for (std::size_t i = 0; i < ends.size(); ++i) json[kIntervalColumns[i]] = ends[i];
    array.push_back(std::move(json));
  }
  return array.printable();
}

std::vector<std::string> summary_warnings(const StudyPlan& plan,
                                          const std::vector<SummaryRow>& rows) {
  struct Cells {
    std::size_t far = 0, wide = 0, all = 0;
  };
  std::map<std::pair<std::string, std::string>, Cells> targets;  // by measure and node
  for (const SummaryRow& row : rows) {
    Cells& cells = targets[{row.measure, row.node}];
    ++cells.all;
    cells.far += row.is_far() ? 1 : 0;
    const auto& precision = plan.precision;
    cells.wide += precision && !is_narrow(*precision, row.measure, row.summary, row.results);
  }
  std::vector<std::string> warnings;
  for (const auto& [target, cells] : targets) {
    if (cells.far != 0) {
      warnings.push_back(fmt::format(
          "'{}' of '{}': in {} of {} cells the progress did not come near its target (see gap)",
          target.first, target.second, cells.far, cells.all));
    }
    if (cells.wide != 0) {
      warnings.push_back(fmt::format(
          "'{}' of '{}': in {} of {} cells the interval is not as narrow as {}, after all {} runs",
          target.first, target.second, cells.wide, cells.all, to_text(*plan.precision), plan.runs));
    }
  }
  return warnings;
}

}  // namespace lockstep::host
