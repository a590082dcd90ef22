#include "cli/tools/log/recorded_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "record/read/recording_reader.h"
#include "record/use/recording_merge.h"
#include "team/team_run.h"

namespace lockstep::host {
namespace {

bool is_main_of(const Document& document, std::string_view tree) {
  if (const Attribute* main = document.find_attribute(0, "main_tree_to_execute")) {
    return main->value == tree;
  }
  return std::ranges::count(document.elements(), "BehaviorTree", &Element::tag) == 1;
}

// Values with the types of the entries that nothing in the tree writes. What was set while the tree
// ran, as by a scenario, may be all that has declared one.
StartValues typed_values(const RecordingHeader& header) {
  const std::map<std::string_view, std::string_view> by_type = {
      {"bool", "true"}, {"int", "0"}, {"double", "0.5"}, {"string", "x"}};
  StartValues values;
  for (const ShapeEntry& it : header.entries) {
    const auto value = by_type.find(it.type);
    if (it.writers.empty() && value != by_type.end()) values.emplace(it.key, value->second);
  }
  return values;
}

}  // namespace

RecordedTree::RecordedTree(const RecordingHeader& header, const std::string& file,
                           const PluginOptions& plugins,
                           const std::function<void(const Loaded&)>& look)
    : file_(file.empty() ? header.file : file), code_(kExitSuccess) {
  if (is_merged(header)) {
    print_error("the recording is of a team, and its trees are in several files",
                "take the recording of one robot");
    code_ = kExitUsage;
    return;
  }
  if (file.empty() && file_ == "-") {
    print_error("the recording is of a tree that was read from a text, not from a file",
                "give a file that has the tree, or in mcp its text");
    code_ = kExitInvalidTree;
    return;
  }
  LoadCommandOptions load;
  load.plugins = plugins;
  load.unknown = MissingNodes::AreMocked;
  load.main_tree = header.id;
  load.main_file = MainFile::IsRegular;
  for (const auto& [name, value] : header.arguments) {
    load.arguments.push_back(fmt::format("{}={}", name, value));
  }
  for (const auto& [key, value] : header.values) {
    load.values.push_back(fmt::format("{}={}", key, value));
  }
  load.later = typed_values(header);
  Diagnostics diagnostics;
  auto loaded = load_given(file_, load, diagnostics);
  print_diagnostics(diagnostics, Severity::Error);
  if (!loaded) {
    code_ = exit_code_of(loaded.error());
    return;
  }
  if (!is_main_of(*loaded->project->documents.front(), header.id)) main_ = header.id;
  if (look) look(*loaded);
  played_.take_over(loaded->definition, stands_for_robots);
  runnable_ = make_runnable(std::move(*loaded));
}

}  // namespace lockstep::host
