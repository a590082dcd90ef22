#include "verify/check/advice.h"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "engine/compile.h"
#include "language/document/reporter.h"
#include "leaves/play/played_leaves.h"
#include "tree/pace.h"

namespace lockstep::host {
namespace {

// Whether the check of names and types has warned of something in the tag of a node.
bool is_doubtful(std::span<const Place> places, Place node, const Sources& sources,
                 const Diagnostics& diagnostics) {
  const SourceLocation begin = sources.locate(node);
  std::optional<SourceLocation> end;
  const auto is_next = [&](Place it) { return it.byte > node.byte; };
  auto behind = places | std::views::filter(is_next);
  const auto next = std::ranges::min_element(behind, {}, &Place::byte);
  if (next != behind.end()) end = sources.locate(*next);
  return std::ranges::any_of(diagnostics.all(), [&](const Diagnostic& it) {
    const auto at = std::pair(it.location.line, it.location.column);
    const bool is_before_end =
        !end || end->file != begin.file || at < std::pair(end->line, end->column);
    return it.severity == Severity::Warning && it.location.file == begin.file &&
           at > std::pair(begin.line, begin.column) && is_before_end;
  });
}

}  // namespace

void add_advice(const Project& project, Definition definition, AdviceEffort effort,
                Diagnostics& diagnostics, std::function<int()> stop_signal) {
  const bool is_certain = effort == AdviceEffort::Certain && project.arguments.empty();
  if (!is_certain) effort = std::min(effort, AdviceEffort::Deadlocks);
  std::vector<Place> places;
  for (const DefinitionNode& node : definition.nodes) places.push_back(node.place);
  PlayedLeaves played;
  played.take_over(definition);
  ignore_pace(definition);
  const Tree tree = compile(definition);
  const Reporter reporter(project.sources, diagnostics);
  for (Advice& it : advice_of(tree, places, effort, std::move(stop_signal))) {
    const bool is_fault = it.code.text() == "always-fault";
    if (is_fault && is_doubtful(places, places[it.node], project.sources, diagnostics)) continue;
    reporter.at(it.code, places[it.node], std::move(it.message), std::move(it.hint), it.severity);
  }
}

void add_advice_of_run(const Project& project, const Definition& definition,
                       Diagnostics& diagnostics) {
  const bool holds = std::ranges::any_of(definition.nodes, [](const DefinitionNode& node) {
    return compares_progress(node.type->synchronization);
  });
  if (holds) add_advice(project, definition, AdviceEffort::Run, diagnostics);
}

}  // namespace lockstep::host
