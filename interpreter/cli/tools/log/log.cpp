#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>

#include "base/system/descriptors.h"
#include "base/system/output_file.h"
#include "base/terminal/fitted.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "record/use/recording_csv.h"
#include "record/use/recording_info.h"

namespace lockstep::host {
namespace {

struct LogOptions {
  std::string file;
  std::string out;
  TickRange range;
};

int csv_to_file(const LogOptions& options, RecordingReader& reader) {
  if (would_overwrite("--out", options.out, files_of(options.file))) return kExitUsage;
  OutputFile out(options.out);
  if (out.descriptor() < 0) {
    print_error(printable(out.error()));
    return kExitUsage;
  }
  int reason = 0;
  const auto write = [&](std::string_view rows) {
    if (!write_all(out.descriptor(), rows)) reason = errno;
    return reason == 0;
  };
  if (write_csv(reader, write, CsvNames::Exact, options.range) && !out.take_name()) reason = errno;
  return reason == 0 ? report_end(reader, options.range) : cannot_use("write", options.out, reason);
}

int csv(const LogOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) {
    if (!options.out.empty()) return csv_to_file(options, reader);
    const auto names = is_terminal(results_file()) ? CsvNames::Printable : CsvNames::Exact;
    int written = kExitSuccess;
    const auto write = [&written](std::string_view rows) {
      written = write_results(rows);
      return written == kExitSuccess;
    };
    // Where a reader stops, the recording is not cut.
    return write_csv(reader, write, names, options.range) ? report_end(reader, options.range)
                                                          : written;
  });
}

int info(const LogOptions& options) {
  return with_recording(options.file, [](RecordingReader& reader) {
    const std::string text = info_text(reader, wants_color(results_file()));
    return write_results_of(reader, fitted(text, results_width()));
  });
}

std::function<int()> define_log(CLI::App& app) {
  const auto options = std::make_shared<LogOptions>();
  app.require_subcommand(1);
  CLI::App* table = app.add_subcommand(
      "csv",
      "One row per tick and active node: tick, time_s, node, path, status, progress, ticked, held, "
      "results");
  CLI::App* summary =
      app.add_subcommand("info", "Print the tree, how the run ended, and the measures");
  for (CLI::App* command : {table, summary}) add_recording_file(*command, options->file);
  table->add_option("--out", options->out, "Write the table to this file instead of stdout")
      ->type_name("FILE");
  add_tick_range(*table, options->range);
  const auto cat = define_log_cat(app);
  const auto events = define_log_events(app);
  const auto other = define_log_export(app);
  const auto measures = define_log_measure(app);
  const auto plot = define_log_plot(app);
  const auto difference = define_log_diff(app);
  const auto page = define_log_page(app);
  const auto check = define_log_check(app);
  const auto scenario = define_log_scenario(app);
  const auto why = define_log_why(app);
  const auto merge = define_log_merge(app);
  return [=] {
    if (cat.app->parsed()) return cat.run();
    if (events.app->parsed()) return events.run();
    if (other.app->parsed()) return other.run();
    if (measures.app->parsed()) return measures.run();
    if (plot.app->parsed()) return plot.run();
    if (difference.app->parsed()) return difference.run();
    if (page.app->parsed()) return page.run();
    if (check.app->parsed()) return check.run();
    if (scenario.app->parsed()) return scenario.run();
    if (why.app->parsed()) return why.run();
    if (merge.app->parsed()) return merge.run();
    return table->parsed() ? csv(*options) : info(*options);
  };
}

}  // namespace

extern const Command kLogCommand{
    "log", "Read recordings of `lockstep run --record`",
    "A truncated recording, such as after a kill, is read up to its last whole line; a message on\n"
    "stderr reports it.\n"
    "Exit code: 0 read, 1 two recordings differ or a property is violated, 2 usage, a file that "
    "cannot\n"
    "be read, or a plot without gnuplot, 3 not a recording or a damaged one, 124 a property is "
    "open.\n"
    "\n"
    "Examples:\n"
    "  lockstep run --example door_pulling --record run.jsonl\n"
    "  lockstep log info run.jsonl\n"
    "  lockstep log why run.jsonl grasp\n"
    "  lockstep log csv run.jsonl > run.csv\n"
    "  lockstep log cat --follow run.jsonl.zst | grep fault\n"
    "  lockstep log events run.jsonl --path 'pull/*' --event hold --event release\n"
    "  lockstep log measure run.jsonl --measure predictability:arm@0.5\n"
    "  lockstep log export run.jsonl --format trace --out run.json\n"
    "  lockstep log plot run.jsonl --out progress.svg\n"
    "  lockstep log page run.jsonl --out run.html\n"
    "  lockstep log diff run.jsonl again.jsonl\n"
    "  lockstep log check run.jsonl --property 'arm.held at most 200 ticks'\n"
    "  lockstep log merge left.jsonl right.jsonl --out team.jsonl\n"
    "  lockstep log scenario run.jsonl --save tree.test.xml",
    define_log};

}  // namespace lockstep::host
