#include "cli/tools/study/study_fault.h"

#include <fmt/format.h>

#include "judge/summary/statistics.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

// In single quotes, for a shell.
std::string quoted(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \t\n\"'\\$`;&|<>()*?[]{}~#!") == std::string::npos) {
    return text;
  }
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string run_command(const StudyOptions& options, const StudyPlan& plan,
                        const StudyFault& fault) {
  const LoadCommandOptions& load = options.load;
  const std::uint64_t cell = fault.row.cell;
  std::string text =
      fmt::format("lockstep run {} --clock virtual --seed {} --rate {} --max-ticks {}",
                  quoted(plan.tree_file), fault.seed, cell_rate(plan, cell), plan.max_ticks);
  const auto add = [&](const char* option, const std::string& value) {
    text += fmt::format(" {} {}", option, quoted(value));
  };
  if (!options.leaves.empty()) add("--leaves", options.leaves);
  if (!load.main_tree.empty()) add("--tree", load.main_tree);
  for (const std::string& pair : load.arguments) add("--arg", pair);
  const auto values = cell_values(plan, cell);
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (plan.grid[axis].kind != GridAxis::Kind::Argument) continue;
    add("--arg", plan.grid[axis].name + '=' + values[axis]);
  }
  for (const std::string& pair : load.values) add("--set", pair);
  for (const std::string& plugin : load.plugins.plugins) add("--plugin", plugin);
  for (const std::string& directory : load.plugins.directories) add("--plugin-path", directory);
  return text;
}

std::string fault_text(const StudyFault& fault, const LoadedStudy& study) {
  const Shape shape = shape_of(study.cells[fault.row.cell].tree);
  const std::string cell = cell_text(study.plan, fault.row.cell);
  return fmt::format("{} {}, in run {} of cell {}{}{}{}, seed {}: {}",
                     describe_node(shape, fault.fault.node), failure_text(fault.fault, fault.ticks),
                     fault.row.run, fault.row.cell, cell.empty() ? "" : " (", cell,
                     cell.empty() ? "" : ")", fault.seed, fault.fault.message);
}

}  // namespace lockstep::host
