#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <system_error>

#include "base/compression/decompressed.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "record/part_names.h"
#include "record/read/recording_parts.h"

namespace lockstep::host {

void add_recording_file(CLI::App& app, std::string& file) {
  app.add_option("file", file,
                 "The recording; - is stdin; of one with --record-rotate: a part, or the name for "
                 "all")
      ->type_name("FILE.jsonl")
      ->required();
}

int with_file(const std::string& path, const std::function<int(std::istream&)>& use,
              NamedRecording::Reading reading) {
  if (path == "-") {
    Decompressed buffer(*std::cin.rdbuf());
    std::istream text(&buffer);
    return use(text);
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return cannot_use("read", path, EISDIR);
  NamedRecording file(path, reading);
  return file.is_open() ? use(file.text()) : cannot_use("read", path, errno);
}

std::vector<NamedFile> files_of(const std::string& path) {
  std::vector<NamedFile> files{named_file(path)};
  for (const std::string& it : files_that_exist(path)) files.push_back(named_file(it));
  return files;
}

int read_recording(std::istream& in, const std::string& path,
                   const std::function<int(RecordingReader&)>& use) {
  RecordingReader reader(in, path == "-" ? "stdin" : path);
  return reader.error().empty() ? use(reader) : report_end(reader);
}

int with_recording(const std::string& path, const std::function<int(RecordingReader&)>& use) {
  return with_file(path, [&](std::istream& in) { return read_recording(in, path, use); });
}

int report_end(const RecordingOutcome& outcome) {
  if (!outcome.error.empty()) {
    print_error(outcome.error);
    return kExitInvalidTree;
  }
  if (!outcome.gaps.empty()) print_note(outcome.gaps);
  if (!outcome.cut.empty()) print_error(fmt::format("the recording is cut: {}", outcome.cut));
  return kExitSuccess;
}

int report_end(const RecordingReader& reader) {
  return report_end(reader.outcome());
}

int report_end(const RecordingReader& reader, TickRange range) {
  const int code = report_end(reader);
  const std::uint64_t ticks = reader.position().next_tick, first = reader.header().first_tick;
  if (code != kExitSuccess) return code;
  if (range.to < first) {
    return usage_error(
        fmt::format("--to {}: this part of the recording begins with tick {}", range.to, first));
  }
  if (range.from < ticks || range.from == 0) return code;
  return usage_error(
      fmt::format("--from {}: the recording has {}", range.from,
                  ticks == first ? "no ticks" : fmt::format("ticks {} to {}", first, ticks - 1)));
}

void add_tick_range(CLI::App& app, TickRange& range) {
  app.add_option("--from", range.from, "The first tick")
      ->type_name("TICK")
      ->transform(whole_number());
  app.add_option("--to", range.to, "The last tick; the rest is not read")
      ->type_name("TICK")
      ->transform(whole_number())
      ->check([&range](const std::string& text) {
        return std::stoull(text) < range.from ? "is before --from" : std::string();
      });
}

int usage_error(const std::string& message) {
  print_error(message);
  return kExitUsage;
}

int cannot_use(std::string_view verb, std::string_view path, int reason) {
  return usage_error(
      fmt::format("cannot {} '{}': {}", verb, printable(path), std::strerror(reason)));
}

int write_results_of(const RecordingReader& reader, std::string_view text) {
  const int written = write_results(text);
  return first_failure(report_end(reader), written);
}

}  // namespace lockstep::host
