#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "base/core/wording.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/properties.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/recorded_tree.h"
#include "judge/measure/property_steps.h"
#include "leaves/leaf_file.h"
#include "leaves/models.h"
#include "record/read/recorded_moments.h"
#include "record/use/recorded_properties.h"
#include "run/leaf_audit.h"
#include "tree/check/plugin_requests.h"
#include "verify/property_watch.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostNamed = 5;  // in one message

struct LogCheckOptions {
  std::string file;
  PropertyOptions properties;
  bool json = false;
  std::string leaves, tree;  // files; "": none, and as the recording names it
  PluginOptions plugins;

  bool has_properties() const { return !properties.texts.empty() || !properties.files.empty(); }
  // Those of the tree file are checked, too.
  bool asks_tree() const { return leaves.empty() && (!tree.empty() || !has_properties()); }
};

int exit_code_of(const PropertyChecks& checks) {
  if (checks.any(PropertyVerdict::Violated)) return kExitFailure;
  return checks.any(PropertyVerdict::Open) ? kExitLimit : kExitSuccess;
}

// Adds those of the tree file, for the nodes that the recording has. The exit code of a failure,
// which is reported.
int add_declared(const LogCheckOptions& options, const RecordingHeader& header,
                 const PropertyNames& names, std::vector<Property>& properties) {
  const RecordedTree recorded(header, options.tree, options.plugins);
  if (recorded.code() != kExitSuccess) return recorded.code();
  for (const Property& it : recorded.properties()) {
    auto again = Property::parse(it.text(), names);
    if (!again) {
      print_error(fmt::format("property '{}' of {} does not fit the recording: {}", it.name(),
                              recorded.file(), again.error().message),
                  "the tree file was changed since: give the one that was run, as --tree-file");
      return kExitUsage;
    }
    again->set_name(it.name());
    properties.push_back(std::move(*again));
  }
  if (!recorded.properties().empty() || options.has_properties()) return kExitSuccess;
  return usage_error(recorded.file() +
                     " has no <property>: give a --property, a --property-file or --leaves");
}

int check_properties(const LogCheckOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    const PropertyNames names = property_names(reader.header());
    std::vector<Property> declared;
    if (options.asks_tree()) {
      const int code = add_declared(options, reader.header(), names, declared);
      if (code != kExitSuccess) return code;
    }
    auto properties =
        all_properties(std::move(declared), options.properties, [&] { return names; });
    if (!properties) return kExitUsage;
    PropertyChecks checks(std::move(*properties));
    check_recording(reader, checks);
    if (!reader.error().empty()) return report_end(reader);
    const std::string text = options.json ? to_json(checks) + "\n" : to_table(checks);
    return first_failure(write_results_of(reader, text), exit_code_of(checks));
  });
}

// Which plugins of the tree are not there: "plugin 'motion' is not found", or "".
std::string missing_plugins(const Loaded& loaded) {
  std::set<std::string> names;
  Diagnostics known;  // loading has told them
  const auto there = loaded.plugins->list();
  for (const PluginRequest& it : requested_plugins(*loaded.project, known)) {
    if (std::ranges::find(there, it.name, &PluginSet::Info::name) == there.end())
      names.insert(fmt::format("'{}'", brief(it.name)));
  }
  if (names.empty()) return {};
  const bool is_one = names.size() == 1;
  return fmt::format("{} {} {} not found", is_one ? "plugin" : "plugins",
                     some_of(names, kMostNamed), is_one ? "is" : "are");
}

// A leaf of a plugin may do what its mock may not: an action of a program may take a tick more.
void tell_of_mocks(const Loaded& loaded) {
  std::set<std::string> types;
  for (const DefinitionNode& it : loaded.definition.nodes) {
    if (it.type->mock != nullptr) types.insert(fmt::format("'{}'", brief(it.type->id)));
  }
  if (types.empty()) return;
  const std::string leaves = some_of(types, kMostNamed), missing = missing_plugins(loaded);
  print_note(printable(missing.empty() ? fmt::format("no plugin has {}: checked as mocks", leaves)
                                       : fmt::format("{}, so {} {} checked as {}", missing, leaves,
                                                     types.size() == 1 ? "is" : "are",
                                                     types.size() == 1 ? "a mock" : "mocks")),
             "give --plugin and --plugin-path as in the run");
}

// Compares what the leaves did with what the leaf file lets them do.
int check_leaves(const LogCheckOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    const RecordedTree recorded(reader.header(), options.tree, options.plugins, tell_of_mocks);
    if (recorded.code() != kExitSuccess) return recorded.code();
    Diagnostics diagnostics;
    const auto file = load_leaf_file(options.leaves, diagnostics);
    if (file == nullptr || diagnostics.has_errors()) {
      print_diagnostics(diagnostics, Severity::Warning);
      return kExitInvalidTree;
    }
    const Tree& tree = recorded.tree();
    const auto properties = all_properties(recorded.properties(), options.properties,
                                           [&] { return names_with_facts(tree, file->facts); });
    if (!properties) return kExitUsage;
    std::vector<NodeProblem> problems;  // of values that nothing declares: they are not compared
    const Observed observed = observed_by(tree, *properties, problems);
    const LeafModels models = make_models(tree, file.get(), diagnostics, problems, observed);
    print_diagnostics(diagnostics, Severity::Warning);
    if (diagnostics.has_errors()) return kExitInvalidTree;
    constexpr std::size_t kMost = 3;  // of each leaf
    const RecordingHeader& header = reader.header();
    LeafAudit audit(header, tree, models, &file->sources);
    RecordedMoments moments(header);
    std::vector<std::size_t> counts(header.nodes.size());
    std::string text;
    const Moment* last = nullptr;
    std::size_t cuts = reader.resumes().size();
    while (const auto tick = reader.next()) {
      const bool is_after_cut =
          reader.resumes().size() > std::exchange(cuts, reader.resumes().size());
      if (is_after_cut && last != nullptr) audit.begin(*last);
      for (const RecordedFault& it : tick->faults) audit.note_fault(it.node);
      last = &moments.read(*tick);
      for (const LeafBreach& it : audit.after_tick(*last, tick->set)) {
        if (counts[it.node]++ >= kMost) continue;
        text += fmt::format("{}: in tick {}: {}\n", printable(header.nodes[it.node].path),
                            tick->tick, it.message);
      }
    }
    if (!reader.error().empty()) return report_end(reader);
    const bool is_good = text.empty();
    if (is_good) text = "the leaves did what the leaf model allows\n";
    return first_failure(write_results_of(reader, text), is_good ? kExitSuccess : kExitFailure);
  });
}

int check(const LogCheckOptions& options) {
  const int leaves = options.leaves.empty() ? kExitSuccess : check_leaves(options);
  if (leaves == kExitUsage) return leaves;  // the properties may be the reason
  if (!options.has_properties() && !options.asks_tree()) return leaves;
  return first_failure(leaves, check_properties(options));
}

}  // namespace

LogSubcommand define_log_check(CLI::App& log) {
  const auto options = std::make_shared<LogCheckOptions>();
  CLI::App* app = log.add_subcommand("check", "Check properties of the run");
  add_recording_file(*app, options->file);
  add_property_options(*app, options->properties);
  app->add_option("--leaves", options->leaves,
                  "A leaf model: report where leaves did what it does not allow")
      ->type_name("FILE");
  app->add_option("--tree-file", options->tree,
                  "The tree file, whose properties are checked too, or whose leaves are with "
                  "--leaves (default: "
                  "as the recording names it)")
      ->type_name("TREE.xml");
  add_plugin_options(*app, options->plugins);
  app->add_flag("--json", options->json, "Print one line of JSON");
  app->footer(
      "Without a property and --leaves it checks the properties of the tree file.\n"
      "holds: whatever comes; violated; open: the run was ended before it was decided.\n"
      "Exit code: 0 all hold, 1 one is violated, or a leaf contradicts the leaf model, 2 usage or "
      "a mistake in a property, 3 not a\n"
      "recording or a damaged one, 124 none is violated, one is open.\n"
      "\n"
      "Examples:\n"
      "  lockstep log check run.jsonl\n"
      "  lockstep log check run.jsonl --property 'never base.progress > 0.9 and arm.idle'");
  return {app, [options] { return check(*options); }};
}

}  // namespace lockstep::host
