#include "cli/tools/verify/probability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/wording.h"
#include "base/json/json.h"
#include "cli/tools/verify/verify_report.h"

namespace lockstep::host {
namespace {

// Bounds that are nearer than this are one number, to six digits.
constexpr double kOneNumber = 1e-6;

struct ProbabilityRow {
  std::string name;
  const Probability& of;
};

std::vector<ProbabilityRow> rows_of(const ProbabilityReport& report) {
  std::vector<ProbabilityRow> rows;
  for (const Status status : {Status::Success, Status::Failure, Status::Skipped}) {
    const auto& it = report.found.results[index_of(status)];
    if (it) rows.push_back({std::string(to_string(status)), *it});
  }
  if (report.found.fault) rows.push_back({"fault", *report.found.fault});
  rows.push_back({"ends", report.found.ends});
  for (std::size_t i = 0; i < report.properties.size(); ++i) {
    rows.push_back(
        {fmt::format("property '{}'", report.properties[i].name()), report.found.properties[i]});
  }
  return rows;
}

// What is printed for both bounds.
double number(const Bounds& it) {
  if (it.low <= 0) return 0;
  return it.high >= 1 ? 1 : (it.low + it.high) / 2;
}

// How far a number may be from the true one.
double error_of(const Probability& it) {
  return std::max(it.least.width(), it.most.width());
}

// "0.973", "0.2 to 0.973", "unknown: in 0.2 to 1".
std::string text_of(const Probability& it) {
  if (error_of(it) > kOneNumber)
    return fmt::format("unknown: in {:.6g} to {:.6g}", it.least.low, it.most.high);
  const double least = number(it.least), most = number(it.most);
  if (most - least <= kOneNumber) return fmt::format("{:.6g}", least);
  return fmt::format("{:.6g} to {:.6g}", least, most);
}

Json as_json(const Bounds& it) {
  Json bounds = Json::array();
  bounds.push_back(it.low);
  bounds.push_back(it.high);
  return bounds;
}

}  // namespace

std::string to_text(const ProbabilityReport& report) {
  const ChanceGraph& graph = report.graph;
  const bool is_complete = graph.end == SearchEnd::Complete;
  std::string text = fmt::format(
      "probability {}: {}, {}\n  {}, {}, {}, {:.2f} s\n", report.tree,
      report.leaf_count == 1 ? "1 leaf" : fmt::format("{} leaves", report.leaf_count),
      report.leaves.empty() ? std::string("no leaf model") : "leaf model " + report.leaves,
      counted(graph.states, "state"), counted(graph.ticks, "tick"),
      is_complete ? std::string("complete") : fmt::format("stopped by {}", limit_of(graph.end)),
      to_seconds(graph.took));
  const std::vector<ProbabilityRow> rows = rows_of(report);
  std::size_t width = 0;
  double error = 0;
  bool has_choices = false;
  for (const ProbabilityRow& it : rows) {
    width = std::max(width, it.name.size());
    error = std::max(error, error_of(it.of));
    has_choices |= number(it.of.most) - number(it.of.least) > kOneNumber;
  }
  width = std::min<std::size_t>(width, 36);
  for (const ProbabilityRow& it : rows)
    text += fmt::format("  {:<{}}  {}\n", it.name, width, text_of(it.of));
  if (error > kOneNumber) {
    text += is_complete
                ? "  not all is known: the time was over before the numbers were near enough\n"
                : "  not all is known: what was not looked at may do anything\n";
  } else {
    if (has_choices)
      text += "  from the least to the largest, over all that has no chance in the leaf model\n";
    text += fmt::format("  error: less than {:.1e}, and the sixth digit is rounded\n",
                        std::max(error, 1e-15) * 1.05);
  }
  return text + to_text(report.costs, report.tree, report.leaves) +
         fmt::format("  assumed: {}; chances are independent\n", joined(report.assumed, "; "));
}

std::string to_json(const ProbabilityReport& report) {
  const ChanceGraph& graph = report.graph;
  Json json = Json::object();
  json["tree"] = report.tree;
  if (!report.leaves.empty()) json["leaves"] = report.leaves;
  json["complete"] = graph.end == SearchEnd::Complete && !report.found.is_cut;
  if (graph.end != SearchEnd::Complete) json["limit"] = std::string(limit_of(graph.end));
  if (!report.costs.empty()) json["costs"] = to_json(report.costs);
  json["states"] = graph.states;
  json["ticks"] = graph.ticks;
  json["seconds"] = to_seconds(graph.took);
  Json all = Json::array();
  for (const ProbabilityRow& it : rows_of(report)) {
    Json row = Json::object();
    row["name"] = it.name;
    row["least"] = as_json(it.of.least);
    row["most"] = as_json(it.of.most);
    all.push_back(std::move(row));
  }
  json["probabilities"] = std::move(all);
  std::vector<std::string> assumed = report.assumed;
  assumed.emplace_back("chances are independent");
  json["assumed"] = Json(assumed);
  return json.printable(2) + '\n';
}

}  // namespace lockstep::host
