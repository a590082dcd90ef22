#include "cli/study/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/diagnostics.h"
#include "core/json.h"
#include "study/column_names.h"
#include "study/precision.h"
#include "terminal/text_table.h"

namespace lockstep {
namespace {

constexpr char kNone[] = "-";

std::string interval_text(const Interval& it, double unit, int digits) {
  return fmt::format("[{:.{}g}, {:.{}g}]", it.low * unit, digits, it.high * unit, digits);
}

// The columns of summary.csv, and the intervals behind what they are of.
TableRow head_of(const StudyPlan& plan) {
  TableRow head = grid_columns(plan);
  for (const std::string_view name : kSummaryColumns) {
    head.emplace_back(name);
    if (name == "median" || std::ranges::find(kResultNames, name) != kResultNames.end())
      head.push_back(fmt::format("95 % of {}", name));
  }
  return head;
}

void append_numbers(const SummaryRow& row, TableRow& line) {
  const SampleSummary& it = row.summary;
  const auto append = [&](double value) {
    line.push_back(it.count == 0 ? kNone : fmt::format("{:.6g}", value));
  };
  for (const double value : {it.min, it.q1, it.median}) append(value);
  line.push_back(it.median_interval ? interval_text(*it.median_interval, 1, 6) : kNone);
  for (const double value : {it.q3, it.max, it.mean}) append(value);
  const ResultCounts& results = row.results;
  line.push_back(fmt::format("{}", it.count));
  line.push_back(fmt::format("{}", results.runs));
  for (std::size_t i = 0; i < kResultNames.size(); ++i) {
    line.push_back(percent(results.of[i], results.runs));
    line.push_back(interval_text(results.interval(i), 100, 3));
  }
}

}  // namespace

std::string summary_table(const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  TableRow head = head_of(plan);
  const std::size_t names = plan.grid.size() + 2;
  const bool has_gaps =
      std::ranges::any_of(rows, [](const SummaryRow& row) { return row.gap.has_value(); });
  if (!has_gaps) head.pop_back();
  std::vector<TableRow> lines{head};
  for (const SummaryRow& row : rows) {
    TableRow line;
    for (const std::string& value : row.grid) line.push_back(printable(value));
    line.push_back(printable(row.node));
    line.push_back(printable(row.measure));
    append_numbers(row, line);
    if (has_gaps) {
      line.push_back(row.gap ? fmt::format("{:.3g}{}", *row.gap, row.is_far() ? " !" : "  ") : "");
    }
    lines.push_back(std::move(line));
  }
  return text_table(lines, names);
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

}  // namespace lockstep
