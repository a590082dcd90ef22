#include "language/pipeline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <catch2/catch.hpp>

#include "engine/compile.h"
#include "language/robot_plugin.h"
#include "run/loading/plugins.h"
#include "run/run.h"
#include "tree/check/plugin_requests.h"
#include "tree/resolve.h"
#include "verify/check/advice.h"

namespace lockstep::host::test {
namespace {

constexpr int kMaxPipelineTicks = 100;

std::string whole_document(std::string_view xml) {
  if (xml.find("<root") != std::string_view::npos) return std::string(xml);
  return fmt::format("<root lockstep=\"1\"><BehaviorTree ID=\"T\">\n{}\n</BehaviorTree></root>",
                     xml);
}

struct Options {
  Arguments arguments;
  ResolveOptions resolve;
};

Options parse(std::string_view text) {
  Options options;
  while (!text.empty()) {
    const auto length = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, length);
    const std::string_view key = word.substr(0, word.find('='));
    const std::string value(word.substr(key.size() + 1));
    if (key == "tree") options.resolve.main_tree = value;
    if (key.starts_with("arg.")) options.arguments.emplace(key.substr(4), value);
    if (key.starts_with("set.")) options.resolve.values.emplace(key.substr(4), value);
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return options;
}

template <class Tell>
void check(std::span<const ClaimRow> rows, Tell tell) {
  for (const ClaimRow& row : rows) {
    INFO("claim: " << row.claim << "\n" << row.xml);
    const Pipeline pipeline(row.xml, row.options);
    CHECK(tell(pipeline) == row.expected);
  }
}

}  // namespace

Pipeline::Pipeline(std::string_view xml, std::string_view options, const std::string& path) {
  REQUIRE(plugins_.add(motion_plugin(), "motion", diagnostics_));
  REQUIRE(plugins_.add(robot_plugin(), "robot", diagnostics_));
  REQUIRE(plugins_.initialize(diagnostics_));
  const Options parsed = parse(options);
  project_ = load_project_text(path, whole_document(xml), parsed.arguments, diagnostics_);
  if (project_ == nullptr) return;
  requested_plugins(*project_, diagnostics_);
  const Catalog catalog = make_catalog(plugins_);
  definition_ = resolve(*project_, catalog, parsed.resolve, diagnostics_);
  if (definition_ && !diagnostics_.has_errors()) tree_ = compile(*definition_);
}

void Pipeline::advise() {
  if (tree_) add_advice(*project_, *definition_, AdviceEffort::Deadlocks, diagnostics_);
}

std::string Pipeline::told() const {
  Diagnostics sorted = diagnostics_;
  sorted.sort();
  std::string lines;
  for (const Diagnostic& it : sorted.all()) {
    if (!lines.empty()) lines += '\n';
    if (it.location.line != 0) lines += fmt::format("{}:{} ", it.location.line, it.location.column);
    lines += fmt::format("{}: {}", to_string(it.severity), it.message);
  }
  return lines;
}

std::string Pipeline::run() const {
  if (!tree_) return told();
  said.clear();
  Status status = Status::Running;
  int tick = 0;
  {
    Run run(*tree_, {});
    while (status == Status::Running && tick < kMaxPipelineTicks && run.fault() == nullptr) {
      status = run.tick(tick++ * run.period());
    }
    if (run.fault() != nullptr) return "fault: " + run.fault()->message;
  }
  const std::string end = fmt::format("{} {}", to_string(status), tick);
  return said.empty() ? end : fmt::format("{}: {}", end, fmt::join(said, ", "));
}

std::string Pipeline::paths() const {
  if (!tree_) return told();
  std::string paths;
  for (NodeIndex node = 0; node < tree_->nodes.size(); ++node) {
    paths += (node == 0 ? "" : " ") + tree_->path(node);
  }
  return paths;
}

void check_told(std::span<const ClaimRow> rows) {
  check(rows, [](const Pipeline& pipeline) { return pipeline.told(); });
}

void check_runs(std::span<const ClaimRow> rows) {
  check(rows, [](const Pipeline& pipeline) { return pipeline.run(); });
}

void check_paths(std::span<const ClaimRow> rows) {
  check(rows, [](const Pipeline& pipeline) { return pipeline.paths(); });
}

}  // namespace lockstep::host::test
