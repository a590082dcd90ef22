#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/system/descriptors.h"
#include "base/system/output_file.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "cli/tools/log/recorded_tree.h"
#include "groot/log.h"
#include "record/use/mcap.h"
#include "record/use/trace.h"

namespace lockstep::host {
namespace {

struct LogExportOptions {
  std::string file, format, out;
  TickRange range;
  double start_time = 0;
  std::string tree;  // with btlog: a file; "": as the recording names it
  PluginOptions plugins;
};

// The same nodes, but for what is beside the tree.
bool has_tree(const RecordingHeader& header, const Tree& tree, std::size_t nodes) {
  std::size_t same = 0;
  while (same < nodes && same < header.nodes.size() &&
         header.nodes[same].path == tree.path(static_cast<NodeIndex>(same))) {
    ++same;
  }
  return same == nodes && (nodes == header.nodes.size() || !header.nodes[nodes].parent);
}

// The tree of the recording, as Groot2 sees it. Nothing: what is wrong was reported.
std::optional<GrootTree> tree_of(const LogExportOptions& options, const RecordingHeader& header,
                                 int& code) {
  Result<GrootTree> shown;
  bool overwrites = false;
  const RecordedTree recorded(header, options.tree, options.plugins, [&](const Loaded& it) {
    shown = groot_tree(it.definition);
    overwrites = would_overwrite("--out", options.out, inputs_of(it, {}));
  });
  code = recorded.code();
  if (code != kExitSuccess) return std::nullopt;
  code = kExitUsage;
  if (overwrites) return std::nullopt;
  if (!shown) {
    print_error(shown.error().message, shown.error().hint);
    return std::nullopt;
  }
  if (has_tree(header, recorded.tree(), shown->order.size())) return std::move(*shown);
  print_error(fmt::format("'{}' is not the tree of the recording", printable(recorded.file())),
              "--tree-file names another file");
  return std::nullopt;
}

int export_to(const LogExportOptions& options, RecordingReader& reader) {
  std::optional<GrootTree> shown;
  int code = kExitSuccess;
  if (options.format == "btlog" && !(shown = tree_of(options, reader.header(), code))) return code;
  OutputFile out(options.out);
  if (out.descriptor() < 0) return usage_error(printable(out.error()));
  int reason = 0;
  const auto write = [&](std::string_view bytes) {
    if (!write_all(out.descriptor(), bytes)) reason = errno;
    return reason == 0;
  };
  const bool is_written =
      shown ? write_groot_log(reader, *shown, options.start_time, write)
      : options.format == "mcap"
          ? write_mcap(reader, {.range = options.range, .start_time = options.start_time}, write)
          : write_trace(reader, options.range, write);
  if (is_written && !out.take_name()) reason = errno;
  if (reason != 0) return cannot_use("write", options.out, reason);
  return report_end(reader, options.range);
}

int export_recording(const LogExportOptions& options) {
  if (options.format == "btlog" && !options.range.is_all()) {
    return usage_error("--format btlog has all ticks: leave out --from and --to");
  }
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
                  "chrome://tracing, a track for each node; btlog: the log that Groot2 replays")
      ->check(one_of({"mcap", "trace", "btlog"}))
      ->required();
  app->add_option("--out", options->out, "The file")->type_name("FILE")->required();
  add_tick_range(*app, options->range);
  app->add_option("--start-time", options->start_time,
                  "With mcap and btlog: when the run began, in seconds since 1970; 0: times are "
                  "those of the run")
      ->type_name("SECONDS")
      ->check(number_between(0, 4e9));
  app->add_option("--tree-file", options->tree,
                  "With btlog: the tree file (default: as the recording names it)")
      ->type_name("TREE.xml");
  add_plugin_options(*app, options->plugins);
  return {app, [options] { return export_recording(*options); }};
}

}  // namespace lockstep::host
