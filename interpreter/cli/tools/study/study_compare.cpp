#include "cli/tools/study/study_compare.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "study/comparison.h"
#include "study/folder.h"

namespace lockstep::host {
namespace {

struct CompareOptions {
  std::string directory;
  std::vector<std::uint64_t> cells;
  bool json = false;
};

std::string cell_line(const StudyPlan& plan, char name, std::uint64_t cell) {
  const std::string text = cell_text(plan, cell);
  return fmt::format("{}: cell {}{}{}\n", name, cell, text.empty() ? "" : ", ", printable(text));
}

std::string_view test_name(const StudyPlan& plan) {
  return plan.paired ? "Wilcoxon signed-rank" : "Mann-Whitney";
}

std::string p_text(double p) {
  return p < 1e-300 ? "<1e-300" : fmt::format("{:.2g}", p);
}

TableRow table_row(const Comparison& it) {
  TableRow row{printable(it.node), printable(it.measure), fmt::format("{}", it.count.first),
               fmt::format("{}", it.count.second)};
  if (!it.found) {
    row.resize(row.size() + 7, "-");
    return row;
  }
  const Comparison::Found& found = *it.found;
  const auto& interval = found.shift.interval;
  const double range = interval ? interval->high - interval->low : 0;
  const auto text_of = [range](double value) { return rounded_within(value, range); };
  for (const double value : {found.medians.first, found.medians.second, found.shift.estimate})
    row.push_back(text_of(value));
  row.push_back(interval ? fmt::format("[{}, {}]", text_of(interval->low), text_of(interval->high))
                         : "-");
  row.push_back(fmt::format("{:.3g}", found.test.effect));
  row.push_back(p_text(found.test.p));
  row.push_back(p_text(found.p_holm));
  return row;
}

std::string comparison_table(const StudyPlan& plan, CellPair cells,
                             const std::vector<Comparison>& all) {
  std::vector<TableRow> rows{{"node", "measure", "n A", "n B", "median A", "median B", "B - A",
                              "95 % of B - A", "effect", "p", "p (Holm)"}};
  for (const Comparison& it : all) rows.push_back(table_row(it));
  return cell_line(plan, 'A', cells.first) + cell_line(plan, 'B', cells.second) +
         fmt::format("{} runs, {} test\n\n", plan.paired ? "paired" : "independent",
                     test_name(plan)) +
         text_table(rows, 2, results_width());
}

Json cell_json(const StudyPlan& plan, std::uint64_t cell) {
  Json grid = Json::object();
  const auto values = cell_values(plan, cell);
  for (std::size_t i = 0; i < values.size(); ++i) grid[plan.grid[i].name] = values[i];
  return Json{{"number", cell}, {"grid", grid}};
}

Json measure_json(const Comparison& it) {
  Json json{{"node", it.node},
            {"measure", it.measure},
            {"n_a", it.count.first},
            {"n_b", it.count.second}};
  const auto& found = it.found;
  const auto add = [&](const char* name, double value) {
    json[name] = found ? Json(value) : Json();
  };
  const Comparison::Found numbers = found.value_or(Comparison::Found{});
  add("median_a", numbers.medians.first);
  add("median_b", numbers.medians.second);
  add("difference", numbers.shift.estimate);
  const auto& interval = numbers.shift.interval;
  json["difference_low"] = interval ? Json(interval->low) : Json();
  json["difference_high"] = interval ? Json(interval->high) : Json();
  add("effect", numbers.test.effect);
  add("p", numbers.test.p);
  add("p_holm", numbers.p_holm);
  return json;
}

std::string comparison_json(const StudyPlan& plan, CellPair cells,
                            const std::vector<Comparison>& all) {
  Json measures = Json::array();
  for (const Comparison& it : all) measures.push_back(measure_json(it));
  return Json{{"a", cell_json(plan, cells.first)},
              {"b", cell_json(plan, cells.second)},
              {"paired", plan.paired},
              {"test", std::string(test_name(plan))},
              {"measures", measures}}
             .printable() +
         "\n";
}

int refuse(std::string_view message, std::string_view hint = {}) {
  print_error(message, hint);
  return kExitUsage;
}

int compare(const CompareOptions& options) {
  const StudyFolder folder(options.directory);
  const auto plan = folder.read_plan();
  if (!plan) return refuse(plan.error().message);
  if (plan->rows == StudyRows::None) {
    return refuse(
        fmt::format("the study in '{}' has no rows, which the tests need", options.directory),
        "make it without --rows none");
  }
  const CellPair cells{options.cells.front(), options.cells.back()};
  if (cells.first == cells.second) return refuse("--cells: expected two different cells");
  for (const std::uint64_t cell : options.cells) {
    if (cell < cell_count(*plan)) continue;
    return refuse(fmt::format("--cells: the study in '{}' has no cell {}", options.directory, cell),
                  fmt::format("it has {}, counted from 0; the column 'cell' of runs.csv has them",
                              counted(cell_count(*plan), "cell")));
  }
  const auto comparisons = compare_cells(folder.file(result_file_name(plan->rows)), *plan, cells);
  if (!comparisons) return refuse(comparisons.error().message, comparisons.error().hint);
  return write_results(options.json ? comparison_json(*plan, cells, *comparisons)
                                    : comparison_table(*plan, cells, *comparisons));
}

}  // namespace

std::function<int()> define_compare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  app.add_option("study", options->directory, "The directory of a study")
      ->type_name("DIR")
      ->required();
  app.add_option("--cells", options->cells, "The numbers of the two cells, as in runs.csv")
      ->type_name("CELL")
      ->expected(2)
      ->transform(whole_number())
      ->required();
  app.add_flag("--json", options->json, "Print the comparison as JSON");
  app.footer(
      "Reports whether the cells differ by more than chance, and by how much: B - A is the shift\n"
      "of Hodges and Lehmann. Its 95 % interval are the shifts that the test does not reject,\n"
      "so it leaves out 0 when p is below 0.05. Of up to 40 pairs of a paired study both are\n"
      "exact, with ties too. See `lockstep docs studies`.\n"
      "Exit code: 0 compared, 2 usage or a study that cannot be read or is not complete.\n"
      "\n"
      "Example:\n"
      "  lockstep study compare study-example5 --cells 0 1");
  return [options] { return compare(*options); };
}

}  // namespace lockstep::host
