#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/log/log.h"
#include "judge/measure/measure_spec.h"
#include "run/stop_signals.h"
#include "study/plots/gnuplot.h"
#include "study/plots/progress_plot.h"
#include "trace/shape.h"

namespace lockstep::host {
namespace {

struct LogPlotOptions {
  std::string file;
  std::string out;
  std::string node;
  PlotSize size;
};

// The nodes to draw; none after an error, which it prints.
std::vector<NodeIndex> chosen_nodes(const LogPlotOptions& options, const RecordingHeader& header) {
  const auto nodes = synchronized_nodes(header);
  if (nodes.empty()) {
    print_error("the recording has no synchronized node, so there is nothing to draw");
    return {};
  }
  if (options.node.empty()) return nodes;
  std::vector<std::string> paths;
  for (const NodeIndex node : nodes) paths.push_back(header.nodes[node].path);
  const auto place = find_path(paths, options.node);
  if (place) return {nodes[*place]};
  print_error(
      fmt::format("--node: among the synchronized nodes: {}", printable(place.error().message)));
  return {};
}

// The file as named for one node, a file for each of several: "x.svg" becomes "x-pull.svg", or
// "x-Main_left_pull.svg" where two nodes are called so.
std::filesystem::path image_of(const LogPlotOptions& options, const ProgressPlot& plot,
                               std::span<const ProgressPlot> plots) {
  std::filesystem::path image = options.out;
  if (plots.size() == 1) return image;
  const auto name_of = [](const ProgressPlot& one) {
    return file_stem(last_segment(one.node.path));
  };
  std::string name = name_of(plot);
  const auto same = std::count_if(plots.begin(), plots.end(), [&](const ProgressPlot& other) {
    return name_of(other) == name;
  });
  if (same > 1) name = file_stem(plot.node.path);
  const std::string stem = image.stem().string() + "-" + name;
  return image.replace_filename(stem + image.extension().string());
}

// A plot is written to three files. None may be the recording.
bool would_replace_recording(const LogPlotOptions& options, std::filesystem::path image) {
  const NamedFile recording[] = {named_file(options.file)};
  for (const std::string& extension :
       {image.extension().string(), std::string(".dat"), std::string(".gp")}) {
    if (would_overwrite("--out", image.replace_extension(extension), recording)) return true;
  }
  return false;
}

int draw_all(const LogPlotOptions& options, std::span<const ProgressPlot> plots) {
  StopSignals::install();  // a signal leaves nothing half drawn
  const auto has_samples = [](const ProgressPlot& it) { return !it.samples.empty(); };
  const bool is_any_drawn = std::ranges::any_of(plots, has_samples);
  int written = kExitSuccess;
  for (const ProgressPlot& plot : plots) {
    if (!has_samples(plot)) {
      const std::string message = fmt::format("no tick reached '{}'", printable(plot.node.path));
      is_any_drawn ? print_note(message) : print_error(message);
      continue;
    }
    const auto image = image_of(options, plot, plots);
    if (would_replace_recording(options, image)) return kExitUsage;
    const PlotResult result = draw(plot, image, options.size);
    if (!result.ok()) {
      print_error(result.error);
      return StopSignals::received() == 0 ? kExitUsage : kExitSignal + StopSignals::received();
    }
    written = first_failure(written, write_results(printable(result.files.back().string()) + "\n"));
  }
  return is_any_drawn ? written : kExitUsage;
}

int plot(const LogPlotOptions& options) {
  if (!is_plot_image(options.out)) {
    return usage_error(fmt::format("--out '{}': expected a name that ends in .svg or .png",
                                   printable(options.out)));
  }
  return with_recording(options.file, [&](RecordingReader& reader) -> int {
    const auto nodes = chosen_nodes(options, reader.header());
    if (nodes.empty()) return kExitUsage;
    const auto plots = progress_plots(reader, nodes, options.size);
    if (const int code = report_end(reader); code != kExitSuccess) return code;
    return draw_all(options, plots);
  });
}

}  // namespace

LogSubcommand define_log_plot(CLI::App& log) {
  const auto options = std::make_shared<LogPlotOptions>();
  CLI::App* app = log.add_subcommand(
      "plot", "Draw the progress of the children of each synchronized node over time (gnuplot)");
  add_recording_file(*app, options->file);
  app->add_option("--out", options->out,
                  "The image, .svg or .png; its data and its gnuplot script are written next to "
                  "it. With several nodes, -NAME is added to it")
      ->type_name("FILE")
      ->required();
  app->add_option("--node", options->node, "Only this node: its path, or the end of it")
      ->type_name("NODE");
  app->add_option("--width", options->size.width,
                  "The width in pixels, at least 360; a PNG has twice as many")
      ->transform(whole_number(PlotSize::kLeastWidth, PlotSize::kMost))
      ->capture_default_str();
  app->add_option("--height", options->size.height,
                  "The height in pixels, at least 240; a PNG has twice as many")
      ->transform(whole_number(PlotSize::kLeastHeight, PlotSize::kMost))
      ->capture_default_str();
  return {app, [options] { return plot(*options); }};
}

}  // namespace lockstep::host
