#include <CLI/CLI.hpp>
#include <cerrno>
#include <memory>
#include <string>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "recording/use/mcap.h"
#include "recording/use/trace.h"
#include "system/descriptors.h"
#include "system/output_file.h"

namespace lockstep::host {
namespace {

struct LogExportOptions {
  std::string file, format, out;
  TickRange range;
  double start_time = 0;
};

int export_to(const LogExportOptions& options, RecordingReader& reader) {
  OutputFile out(options.out);
  if (out.descriptor() < 0) return usage_error(printable(out.error()));
  int reason = 0;
  const auto write = [&](std::string_view bytes) {
    if (!write_all(out.descriptor(), bytes)) reason = errno;
    return reason == 0;
  };
  const bool is_written =
      options.format == "mcap"
          ? write_mcap(reader, {.range = options.range, .start_time = options.start_time}, write)
          : write_trace(reader, options.range, write);
  if (is_written && !out.take_name()) reason = errno;
  if (reason != 0) return cannot_use("write", options.out, reason);
  return report_end(reader, options.range);
}

int export_recording(const LogExportOptions& options) {
  if (would_overwrite("--out", options.out, files_of(options.file))) return kExitUsage;
  return with_recording(options.file,
                        [&](RecordingReader& reader) { return export_to(options, reader); });
}

}  // namespace

LogSubcommand define_log_export(CLI::App& log) {
  const auto options = std::make_shared<LogExportOptions>();
  CLI::App* app = log.add_subcommand("export", "Write the recording in another format");
  add_recording_file(*app, options->file);
  app->add_option("--format", options->format,
                  "mcap: for Foxglove and PlotJuggler; trace: JSON for ui.perfetto.dev and "
                  "chrome://tracing, a track for each node")
      ->check(CLI::IsMember({"mcap", "trace"}))
      ->required();
  app->add_option("--out", options->out, "The file")->type_name("FILE")->required();
  add_tick_range(*app, options->range);
  app->add_option(
         "--start-time", options->start_time,
         "With mcap: when the run began, in seconds since 1970; 0: times are those of the run")
      ->type_name("SECONDS")
      ->check(number_between(0, 4e9));
  return {app, [options] { return export_recording(*options); }};
}

}  // namespace lockstep::host
