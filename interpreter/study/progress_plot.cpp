#include "study/progress_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/diagnostics.h"
#include "study/gnuplot.h"

namespace lockstep {
namespace {

// Below the axis each child has a strip that shows when it was held.
constexpr double kStripTop = -0.05, kStripStep = 0.055, kStripHeight = 0.034;

double strip_middle(std::size_t child) {
  return kStripTop - kStripStep * (static_cast<double>(child) + 0.5);
}

bool is_relative(const ProgressPlot& plot) {
  return plot.node.synchronization == Synchronization::Relative;
}

std::string sample_lines(const ProgressPlot& plot) {
  std::string text = "# time_s least most_allowed";
  for (const std::string& child : plot.children) text += " " + printable(child);
  text += "\n";
  for (const ProgressSample& sample : plot.samples) {
    if (sample.begins && &sample != plot.samples.data()) text += "\n";
    const double least = *std::min_element(sample.progress.begin(), sample.progress.end());
    const double limit = is_relative(plot) ? std::min(1.0, least + plot.node.delta) : 1.0;
    text +=
        fmt::format("{} {} {} {}\n", sample.time, least, limit, fmt::join(sample.progress, " "));
  }
  return text;
}

// One line for each time that the child was held without a break.
std::string held_lines(const ProgressPlot& plot, std::size_t child) {
  std::string text;
  std::optional<double> since;
  double before = 0;
  const auto end_at = [&](double time) {
    if (since && time > *since) text += fmt::format("{} {} {}\n", *since, time, child);
    since.reset();
  };
  for (const ProgressSample& sample : plot.samples) {
    if (sample.begins) end_at(before);  // it was halted there
    if (!sample.held[child]) end_at(sample.time);
    if (sample.held[child] && !since) since = sample.time;
    before = sample.time;
  }
  end_at(before);
  return text;
}

bool is_ever_held(const ProgressPlot& plot, std::size_t child) {
  return !held_lines(plot, child).empty();
}

std::string caption(const ProgressPlot& plot) {
  if (is_relative(plot)) return fmt::format("{}   (delta = {})", plot.node.path, plot.node.delta);
  const std::size_t barriers = plot.node.barriers.size();
  if (barriers == 0) return plot.node.path + "   (no barriers)";
  return fmt::format("{}   ({} barrier{})", plot.node.path, barriers, barriers == 1 ? "" : "s");
}

std::string band_command() {
  return "  data index 0 using 1:2:3 with filledcurves fc rgb '#e4e4e4' fs solid noborder "
         "title 'delta band', \\\n";
}

// The first is the entry of the legend.
std::string barrier_commands(const ProgressPlot& plot) {
  std::string text;
  const bool many = plot.node.barriers.size() > 12;
  for (const double barrier : plot.node.barriers) {
    text += fmt::format("  {} with lines lc rgb '{}' lw 0.8 {} {}, \\\n", barrier,
                        many ? "#cccccc" : "#808080", many ? "dt 1" : "dt (6,4)",
                        text.empty() ? "title 'barrier'" : "notitle");
  }
  return text;
}

std::string child_command(const ProgressPlot& plot, std::size_t child) {
  return fmt::format("  data index 0 using 1:{} with lines lc rgb '{}' lw 2.2 title {}", child + 4,
                     plot_color(child), gnuplot_string(plot.children[child]));
}

// `place`: among the held blocks of the data, which only children that were held have.
std::string held_command(std::size_t child, std::size_t place) {
  return fmt::format(
      "  data index {} using 1:({}):1:2:({}):({}) with boxxyerror fc rgb '{}' fs solid noborder "
      "notitle",
      place + 1, strip_middle(child), strip_middle(child) - kStripHeight / 2,
      strip_middle(child) + kStripHeight / 2, plot_color(child));
}

std::string plot_command(const ProgressPlot& plot) {
  std::string text = "plot \\\n";
  text += is_relative(plot) ? band_command() : barrier_commands(plot);
  std::size_t place = 0;
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    text += child_command(plot, child) + (child + 1 < plot.children.size() ? ", \\\n" : "");
  }
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    if (is_ever_held(plot, child)) text += ", \\\n" + held_command(child, place++);
  }
  return text + "\n";
}

std::string axes(const ProgressPlot& plot) {
  const std::size_t children = plot.children.size();
  const double bottom = strip_middle(children) + kStripStep / 4;
  const double begin = plot.samples.front().time, end = plot.samples.back().time;
  std::string text = fmt::format("set xrange [{}:{}]\nset yrange [{:.4g}:1.02]\n", begin,
                                 end > begin ? end : begin + 1, bottom);
  text += "set ytics nomirror scale 0.5 0,0.25,1\n";
  text += fmt::format("set label 'held' at graph -0.02, first {:.4g} right\n",
                      (strip_middle(0) + strip_middle(children - 1)) / 2);
  return text;
}

}  // namespace

std::string progress_plot_data(const ProgressPlot& plot) {
  std::string text = sample_lines(plot);
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    const std::string held = held_lines(plot, child);
    if (held.empty()) continue;
    text += fmt::format("\n\n# {} is held: from_s to_s child\n", printable(plot.children[child]));
    text += held;
  }
  return text;
}

std::string progress_plot_script(const ProgressPlot& plot, const std::filesystem::path& image,
                                 PlotSize size) {
  const std::string stem = image.stem().string();
  std::string text = "# Made by lockstep: progress of the children of a synchronized node; below, ";
  text += fmt::format("when each was held.\n# To draw it again: gnuplot {}.gp\n", printable(stem));
  text += fmt::format("data = {}\nset encoding utf8\n", gnuplot_file(stem + ".dat"));
  text += fmt::format("set title {} noenhanced\n", gnuplot_string(caption(plot)));
  text += "set samples 2\n";  // a barrier is a straight line: two points, not a hundred
  text += "set xlabel 'time (s)'\nset ylabel 'progress'\n" + axes(plot);
  text +=
      "set xtics nomirror out scale 0.5\n"
      "set grid ytics lt 1 lw 0.6 lc rgb '#e6e6e6'\n"
      "set border 3 lw 0.8 lc rgb '#404040'\n"
      "set xzeroaxis lt 1 lw 0.8 lc rgb '#404040'\n"
      "set key outside right top reverse Left samplen 2 noenhanced\n";
  return text + gnuplot_terminal(image, size) + plot_command(plot);
}

PlotResult draw(const ProgressPlot& plot, const std::filesystem::path& image, PlotSize size) {
  return draw(PlotFiles{.directory = image.parent_path(),
                        .stem = image.stem().string(),
                        .data = progress_plot_data(plot),
                        .script = progress_plot_script(plot, image, size),
                        .images = {image.filename().string()}});
}

}  // namespace lockstep
