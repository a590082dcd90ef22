#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/suggest.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/log/log.h"
#include "leaves/models.h"
#include "record/use/recording_events.h"

namespace lockstep::host {
namespace {

struct LogEventsOptions {
  std::string file;
  std::string format = "text";
  TickRange range;
  std::vector<std::string> paths, kinds;
};

// The end of the path is enough for a node: "arm" is "Main/pull/arm".
bool means(const std::string& pattern, std::string_view what) {
  return matches(pattern, what) || matches("*/" + pattern, what);
}

// The patterns that have meant nothing yet.
class UnknownPaths {
 public:
  UnknownPaths(const std::vector<std::string>& patterns, const RecordingHeader& header)
      : header_(header), patterns_(patterns) {
    for (const ShapeNode& it : header.nodes) see(it.path);
    for (const ShapeEntry& it : header.entries) see(it.key);
  }

  // Also who logs, which may be a plugin.
  void see(std::string_view what) {
    std::erase_if(patterns_, [&](const std::string& it) { return means(it, what); });
  }

  int tell() const {
    if (patterns_.empty()) return kExitSuccess;
    std::vector<std::string_view> known;
    for (const ShapeNode& it : header_.nodes) known.emplace_back(it.path);
    for (const ShapeEntry& it : header_.entries) known.emplace_back(it.key);
    const std::string& first = patterns_.front();
    print_error(fmt::format("--path {}: no node, entry or leaf that logs is called so", first),
                suggest_path(first, known, "there are"));
    return kExitUsage;
  }

 private:
  const RecordingHeader& header_;
  std::vector<std::string> patterns_;
};

bool is_chosen(const LogEventsOptions& options, const RecordingEvent& event) {
  const auto is_meant = [&](const std::string& pattern) { return means(pattern, event.what); };
  const bool is_of_path = options.paths.empty() || std::ranges::any_of(options.paths, is_meant);
  const bool is_of_kind =
      options.kinds.empty() ||
      std::ranges::find(options.kinds, to_string(event.kind)) != options.kinds.end();
  return is_of_path && is_of_kind;
}

int events(const LogEventsOptions& options) {
  const bool is_csv = options.format == "csv", is_json = options.format == "json";
  return with_recording(options.file, [&](RecordingReader& reader) {
    constexpr std::size_t kFull = 1u << 16u;
    std::string lines = is_csv ? "tick,time_s,event,what,value\n" : "";
    int written = kExitSuccess;
    const auto write = [&] {
      written = write_results(lines);
      lines.clear();
      return written == kExitSuccess;
    };
    UnknownPaths unknown(options.paths, reader.header());
    each_event(reader, options.range, [&](const RecordingEvent& event) {
      unknown.see(event.what);
      if (!is_chosen(options, event)) return true;
      lines += is_csv    ? event_csv(event)
               : is_json ? event_json(event)
                         : printable(event_line(event));
      lines += '\n';
      return lines.size() < kFull || write();
    });
    if (written == kExitSuccess) write();
    if (written != kExitSuccess) return written;
    const int code = report_end(reader, options.range);
    return code == kExitSuccess ? unknown.tell() : code;
  });
}

}  // namespace

LogSubcommand define_log_events(CLI::App& log) {
  const auto options = std::make_shared<LogEventsOptions>();
  CLI::App* app = log.add_subcommand(
      "events", "One line for each start, result, halt, hold, fault, changed entry and log line");
  add_recording_file(*app, options->file);
  app->add_option("--format", options->format,
                  "text, csv with a header, or json with one object a line")
      ->check(one_of({"text", "csv", "json"}))
      ->capture_default_str();
  app->add_option("--path", options->paths,
                  "Only events of these nodes, entries and logging leaves: the end of a path or "
                  "key, in which * stands for any part; may be repeated")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  app->add_option("--event", options->kinds,
                  "Only events of this kind, such as --event hold --event release")
      ->type_name("EVENT")
      ->allow_extra_args(false)
      ->check(one_of(std::vector<std::string>(kEventNames.begin(), kEventNames.end())));
  add_tick_range(*app, options->range);
  return {app, [options] { return events(*options); }};
}

}  // namespace lockstep::host
