#include <CLI/CLI.hpp>
#include <memory>

#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/properties.h"
#include "cli/tools/log/log.h"
#include "recording/use/recorded_properties.h"

namespace lockstep::host {
namespace {

struct LogCheckOptions {
  std::string file;
  PropertyOptions properties;
  bool json = false;
};

int exit_code_of(const PropertyChecks& checks) {
  if (checks.any(PropertyVerdict::Violated)) return kExitFailure;
  return checks.any(PropertyVerdict::Open) ? kExitLimit : kExitSuccess;
}

int check(const LogCheckOptions& options) {
  if (options.properties.texts.empty() && options.properties.files.empty()) {
    return usage_error("log check needs a --property or a --property-file");
  }
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

}  // namespace

LogSubcommand define_log_check(CLI::App& log) {
  const auto options = std::make_shared<LogCheckOptions>();
  CLI::App* app = log.add_subcommand("check", "Check properties of the run");
  add_recording_file(*app, options->file);
  add_property_options(*app, options->properties);
  app->add_flag("--json", options->json, "Print one line of JSON");
  app->footer(
      "holds: whatever comes; violated; open: the run was ended before it was decided.\n"
      "Exit code: 0 all hold, 1 one is violated, 2 usage or a mistake in a property, 3 not a\n"
      "recording or a damaged one, 124 none is violated, one is open.\n"
      "\n"
      "Example:\n"
      "  lockstep log check run.jsonl --property 'never base.progress > 0.9 and arm.idle'");
  return {app, [options] { return check(*options); }};
}

}  // namespace lockstep::host
