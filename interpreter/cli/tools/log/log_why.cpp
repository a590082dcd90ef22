#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "base/terminal/fitted.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "record/use/recording_why.h"

namespace lockstep::host {
namespace {

struct LogWhyOptions {
  std::string file, node;
  std::optional<std::uint64_t> at;
  bool json = false;
};

int print_why(const LogWhyOptions& options, RecordingReader& reader) {
  const auto why = why_of(reader, options.node, options.at);
  if (!reader.error().empty()) return report_end(reader);
  if (!why) {
    print_error(printable(why.error().message), printable(why.error().hint));
    return kExitUsage;
  }
  if (options.json) return write_results(to_json(*why));
  return write_results(fitted(to_text(*why, wants_color(results_file())), results_width()));
}

}  // namespace

LogSubcommand define_log_why(CLI::App& log) {
  const auto options = std::make_shared<LogWhyOptions>();
  CLI::App* app = log.add_subcommand(
      "why", "Print why a node failed, waits or does not run, with the reasons of its leaves");
  add_recording_file(*app, options->file);
  app->add_option("node", options->node,
                  "The node: its path or the end of it (default: the root of the tree)")
      ->type_name("NODE");
  app->add_option("--at", options->at, "As of this tick (default: the last)")
      ->type_name("TICK")
      ->transform(whole_number());
  app->add_flag("--json", options->json, "Print one line of JSON");
  app->footer("Example:\n  lockstep log why run.jsonl grasp --at 120");
  return {app, [options] {
            return with_recording(options->file, [&](RecordingReader& reader) {
              return print_why(*options, reader);
            });
          }};
}

}  // namespace lockstep::host
