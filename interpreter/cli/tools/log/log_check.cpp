#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/properties.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/recorded_tree.h"
#include "leaves/leaf_file.h"
#include "leaves/models.h"
#include "recording/use/recorded_properties.h"
#include "scenario/leaf_audit.h"

namespace lockstep::host {
namespace {

struct LogCheckOptions {
  std::string file;
  PropertyOptions properties;
  bool json = false;
  std::string leaves, tree;  // files; "": none, and as the recording names it
  PluginOptions plugins;
};

int exit_code_of(const PropertyChecks& checks) {
  if (checks.any(PropertyVerdict::Violated)) return kExitFailure;
  return checks.any(PropertyVerdict::Open) ? kExitLimit : kExitSuccess;
}

int check_properties(const LogCheckOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    auto properties = read_properties(options.properties, property_names(reader.header()));
    if (!properties) return kExitUsage;
    PropertyChecks checks(std::move(*properties));
    check_recording(reader, checks);
    if (!reader.error().empty()) return report_end(reader);
    const std::string text = options.json ? to_json(checks) + "\n" : to_table(checks);
    return first_failure(write_results_of(reader, text), exit_code_of(checks));
  });
}

// Compares what the leaves did with what the leaf file lets them do.
int check_leaves(const LogCheckOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    const RecordedTree recorded(reader.header(), options.tree, options.plugins);
    if (recorded.code() != kExitSuccess) return recorded.code();
    Diagnostics diagnostics;
    const auto file = load_leaf_file(options.leaves, diagnostics);
    if (file == nullptr || diagnostics.has_errors()) {
      print_diagnostics(diagnostics, Severity::Warning);
      return kExitInvalidTree;
    }
    std::vector<NodeProblem> problems;  // of what is written: it is not compared
    const LeafModels models = make_models(recorded.tree(), file.get(), diagnostics, problems);
    const bool is_good = !diagnostics.has_errors();
    print_diagnostics(diagnostics, Severity::Warning);
    if (!is_good) return kExitInvalidTree;
    const auto breaches = audit_leaves(reader, recorded.tree(), models);
    if (!reader.error().empty()) return report_end(reader);
    std::string text;
    for (const LeafBreach& it : breaches) {
      text += fmt::format("{}: in tick {}: {}\n", printable(it.path), it.tick, it.message);
    }
    if (breaches.empty()) text = "the leaves did what the leaf file allows\n";
    return first_failure(write_results_of(reader, text),
                         breaches.empty() ? kExitSuccess : kExitFailure);
  });
}

int check(const LogCheckOptions& options) {
  const bool has_properties =
      !options.properties.texts.empty() || !options.properties.files.empty();
  if (!has_properties && options.leaves.empty()) {
    return usage_error("log check needs a --property, a --property-file or --leaves");
  }
  const int leaves = options.leaves.empty() ? kExitSuccess : check_leaves(options);
  if (!has_properties) return leaves;
  const int properties = check_properties(options);
  return first_failure(leaves, properties);
}

}  // namespace

LogSubcommand define_log_check(CLI::App& log) {
  const auto options = std::make_shared<LogCheckOptions>();
  CLI::App* app = log.add_subcommand("check", "Check properties of the run");
  add_recording_file(*app, options->file);
  add_property_options(*app, options->properties);
  app->add_option("--leaves", options->leaves,
                  "A leaf file: where did leaves what it does not allow?")
      ->type_name("FILE");
  app->add_option("--tree-file", options->tree,
                  "With --leaves: the tree file (default: as the recording names it)")
      ->type_name("TREE.xml");
  add_plugin_options(*app, options->plugins);
  app->add_flag("--json", options->json, "Print one line of JSON");
  app->footer(
      "holds: whatever comes; violated; open: the run was ended before it was decided.\n"
      "Exit code: 0 all hold, 1 one is violated, or a leaf broke the leaf file, 2 usage or a "
      "mistake in a property, 3 not a\n"
      "recording or a damaged one, 124 none is violated, one is open.\n"
      "\n"
      "Example:\n"
      "  lockstep log check run.jsonl --property 'never base.progress > 0.9 and arm.idle'");
  return {app, [options] { return check(*options); }};
}

}  // namespace lockstep::host
