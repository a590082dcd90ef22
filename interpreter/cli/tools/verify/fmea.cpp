#include "cli/tools/verify/fmea.h"

#include <fmt/format.h>

#include <functional>

#include "base/core/csv_field.h"
#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/json/json.h"

namespace lockstep::host {
namespace {

class FmeaWriter {
 public:
  explicit FmeaWriter(const FmeaReport& report) : report_(report) {}

  std::string as_json() const {
    Json all = Json::array();
    for (const FailureRow& row : report_.rows) {
      Json failures = Json::array();
      for (const FailureCase& it : row.cases)
        failures.push_back(Json{{"leaf", path(leaf_node(it))}, {"failure", to_string(it.failure)}});
      Json results = Json::object();
      for (const StatusRow& it : kStatuses)
        if (const auto& ticks = row.results[index_of(it.status)])
          results.add(std::string(it.name), *ticks / report_.rate);
      Json json{{"failures", std::move(failures)},
                {"results", std::move(results)},
                {"fault", row.faults},
                {"may_not_end", row.may_not_end},
                {"complete", row.is_complete},
                {"handled_by", row.handled_by ? Json(path(*row.handled_by)) : Json()},
                {"halted", paths(row.halted)},
                {"not_tried", paths(row.not_tried)},
                {"violated", violated(row)},
                {"harmless", row.is_harmless()}};
      all.push_back(std::move(json));
    }
    return all.printable(2) + "\n";
  }

  std::string as_table(const std::function<std::string(const std::vector<std::string>&)>& line,
                       const std::string& below_head) const {
    std::string text = line({"Leaf", "Failure", "Tree", "Handled by", "Halted", "Not tried",
                             "Property violated"}) +
                       below_head;
    for (const FailureRow& row : report_.rows) {
      std::vector<std::string> leaves, failures;
      for (const FailureCase& it : row.cases) {
        leaves.push_back(path(leaf_node(it)));
        failures.emplace_back(to_string(it.failure));
      }
      text += line({joined(leaves, "; "), joined(failures, "; "), outcome(row),
                    row.handled_by ? path(*row.handled_by) : "", joined(paths(row.halted), "; "),
                    joined(paths(row.not_tried), "; "), joined(violated(row), "; ")});
    }
    return text;
  }

 private:
  NodeIndex leaf_node(const FailureCase& it) const { return report_.tree.leaves[it.leaf].node; }
  std::string path(NodeIndex node) const { return report_.tree.path(node); }

  std::vector<std::string> paths(const std::vector<NodeIndex>& nodes) const {
    std::vector<std::string> all;
    for (const NodeIndex it : nodes) all.push_back(path(it));
    return all;
  }

  std::vector<std::string> violated(const FailureRow& row) const {
    std::vector<std::string> all;
    for (const std::size_t it : row.violated) all.push_back(report_.properties[it].name());
    return all;
  }

  // "failure (from 0.1 s), may not end"
  std::string outcome(const FailureRow& row) const {
    std::vector<std::string> all;
    for (const StatusRow& it : kStatuses) {
      if (const auto& ticks = row.results[index_of(it.status)])
        all.push_back(fmt::format("{} (from {:g} s)", it.name, *ticks / report_.rate));
    }
    if (row.faults) all.emplace_back("ends with a fault");
    if (row.may_not_end) all.emplace_back("may not end");
    if (!row.is_complete) all.emplace_back("more may happen: the search had a limit");
    return joined(all, ", ");
  }

  const FmeaReport& report_;
};

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> fields;
  for (const std::string& it : cells) fields.push_back(csv_field(it));
  return joined(fields, ",") + "\n";
}

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += ' ';
    for (const char it : printable(cell))
      line += it == '|' ? std::string("\\|") : std::string(1, it);
    line += " |";
  }
  return line + "\n";
}

}  // namespace

std::string to_text(const FmeaReport& report, std::string_view format) {
  const FmeaWriter writer(report);
  if (format == "json") return writer.as_json();
  if (format == "csv") return writer.as_table(csv_line, "");
  return writer.as_table(markdown_line, "|---|---|---|---|---|---|---|\n");
}

}  // namespace lockstep::host
