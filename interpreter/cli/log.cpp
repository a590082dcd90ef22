#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/log.h"
#include "observers/recording_csv.h"
#include "observers/recording_info.h"

namespace lockstep {
namespace {

struct LogOptions {
  std::string file;
  std::string out;
};

int csv_to_file(const LogOptions& options, RecordingReader& reader) {
  std::error_code error;
  if (std::filesystem::equivalent(options.file, options.out, error)) {
    print_error("--out names the recording itself");
    return kExitUsage;
  }
  std::FILE* out = std::fopen(options.out.c_str(), "wb");
  if (out == nullptr) return cannot_use("write", options.out, errno);
  const bool written = write_csv(reader, out);
  const int reason = errno;
  if (std::fclose(out) != 0 || !written)
    return cannot_use("write", options.out, written ? errno : reason);
  return report_end(reader);
}

int csv(const LogOptions& options) {
  return with_recording(options.file, [&](RecordingReader& reader) {
    if (!options.out.empty()) return csv_to_file(options, reader);
    const auto names = is_terminal(stdout) ? CsvNames::Printable : CsvNames::Exact;
    const int code = end_of_stdout(write_csv(reader, stdout, names));
    const int read = report_end(reader);
    return read == kExitSuccess ? code : read;
  });
}

int info(const LogOptions& options) {
  return with_recording(options.file, [](RecordingReader& reader) {
    try {
      write_info(reader, stdout, wants_color(stdout));
    } catch (const std::system_error& error) {  // fmt cannot write
      errno = error.code().value();
      return end_of_stdout(false);
    }
    const int code = end_of_stdout(std::fflush(stdout) == 0);
    const int read = report_end(reader);
    return read == kExitSuccess ? code : read;
  });
}

std::function<int()> define_log(CLI::App& app) {
  const auto options = std::make_shared<LogOptions>();
  app.require_subcommand(1);
  CLI::App* table = app.add_subcommand(
      "csv", "One row per tick and active node: tick,time_s,node,path,status,progress,ticked,held");
  CLI::App* summary =
      app.add_subcommand("info", "What the recording is of, how it ended, and its measures");
  for (CLI::App* command : {table, summary}) add_recording_file(*command, options->file);
  table->add_option("--out", options->out, "Write the table to this file instead of stdout")
      ->type_name("FILE");
  const auto measures = define_log_measure(app);
  const auto plot = define_log_plot(app);
  const auto difference = define_log_diff(app);
  return [=] {
    if (measures.app->parsed()) return measures.run();
    if (plot.app->parsed()) return plot.run();
    if (difference.app->parsed()) return difference.run();
    return table->parsed() ? csv(*options) : info(*options);
  };
}

}  // namespace

const Command kLogCommand{"log", "Read recordings that `lockstep run --record` has made",
                          "A recording that ends early, as after a kill, is read up to its last "
                          "whole line; a message on\n"
                          "stderr says so.\n"
                          "Exit code: 0 read, 1 two recordings differ, 2 usage, a file that "
                          "cannot be read, or a plot\n"
                          "without gnuplot, 3 not a recording or a damaged one.\n"
                          "\n"
                          "Examples:\n"
                          "  lockstep run trees/door_pulling.xml --record run.jsonl\n"
                          "  lockstep log info run.jsonl\n"
                          "  lockstep log csv run.jsonl > run.csv\n"
                          "  lockstep log measure run.jsonl --measure predictability:arm@0.5\n"
                          "  lockstep log plot run.jsonl --out progress.svg\n"
                          "  lockstep log diff run.jsonl again.jsonl",
                          define_log};

}  // namespace lockstep
