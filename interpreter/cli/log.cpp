#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "observers/recording_csv.h"
#include "observers/recording_info.h"

namespace lockstep {
namespace {

struct Options {
  std::string file;
  std::string out;
};

int cannot(std::string_view what, std::string_view path, int reason) {
  print_error(fmt::format("cannot {} '{}': {}", what, printable(path), std::strerror(reason)));
  return kExitUsage;
}

// A reader that stops reading, as `head` does, is no error.
int end_of_output(bool written) {
  if (!written && errno == EPIPE) std::exit(kExitSuccess);
  return flush_stdout() ? kExitSuccess : kExitUsage;
}

int report(const RecordingReader& reader) {
  if (!reader.error().empty()) {
    print_error(reader.error());
    return kExitInvalidTree;
  }
  if (!reader.cut().empty()) print_error(fmt::format("the recording is cut: {}", reader.cut()));
  return kExitSuccess;
}

// Opens the recording and hands its reader to `use`.
template <class Use>
int with_recording(const std::string& path, Use use) {
  std::ifstream file;
  if (path != "-") {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return cannot("read", path, EISDIR);
    errno = 0;
    file.open(path, std::ios::binary);
    if (!file) return cannot("read", path, errno);
  }
  RecordingReader reader(path == "-" ? std::cin : file, path == "-" ? "stdin" : path);
  return reader.error().empty() ? use(reader) : report(reader);
}

int csv_to_file(const Options& options, RecordingReader& reader) {
  std::error_code error;
  if (std::filesystem::equivalent(options.file, options.out, error)) {
    print_error("--out names the recording itself");
    return kExitUsage;
  }
  std::FILE* out = std::fopen(options.out.c_str(), "wb");
  if (out == nullptr) return cannot("write", options.out, errno);
  const bool written = write_csv(reader, out);
  const int reason = errno;
  if (std::fclose(out) != 0 || !written)
    return cannot("write", options.out, written ? errno : reason);
  return report(reader);
}

int csv(const Options& options) {
  return with_recording(options.file, [&](RecordingReader& reader) {
    if (!options.out.empty()) return csv_to_file(options, reader);
    const int code = end_of_output(write_csv(reader, stdout));
    const int read = report(reader);
    return read == kExitSuccess ? code : read;
  });
}

int info(const Options& options) {
  return with_recording(options.file, [](RecordingReader& reader) {
    try {
      write_info(reader, stdout, wants_color(stdout));
    } catch (const std::system_error& error) {  // fmt cannot write
      errno = error.code().value();
      return end_of_output(false);
    }
    const int code = end_of_output(std::fflush(stdout) == 0);
    const int read = report(reader);
    return read == kExitSuccess ? code : read;
  });
}

std::function<int()> define(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  app.require_subcommand(1);
  CLI::App* table = app.add_subcommand(
      "csv", "One row per tick and active node: tick,time_s,node,path,status,progress,ticked,held");
  CLI::App* summary =
      app.add_subcommand("info", "What the recording is of, how it ended, and its measures");
  for (CLI::App* command : {table, summary}) {
    command->add_option("file", options->file, "The recording; - is stdin")
        ->type_name("FILE.jsonl")
        ->required();
  }
  table->add_option("--out", options->out, "Write the table to this file instead of stdout")
      ->type_name("FILE");
  return [options, table] { return table->parsed() ? csv(*options) : info(*options); };
}

}  // namespace

const Command kLogCommand{"log", "Read recordings that `lockstep run --record` has made",
                          "A recording that ends early, as after a kill, is read up to its last "
                          "whole line; a message on\n"
                          "stderr says so.\n"
                          "Exit code: 0 read, 2 usage or a file that cannot be read, 3 not a "
                          "recording or a damaged one.\n"
                          "\n"
                          "Examples:\n"
                          "  lockstep run trees/door_pulling.xml --record run.jsonl\n"
                          "  lockstep log info run.jsonl\n"
                          "  lockstep log csv run.jsonl > run.csv",
                          define};

}  // namespace lockstep
