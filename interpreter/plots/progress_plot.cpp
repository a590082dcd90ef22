#include "plots/progress_plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/diagnostics.h"
#include "plots/gnuplot.h"
#include "plots/plot_style.h"
#include "summary/summary.h"

namespace lockstep {
namespace {

// Below the axis each child has a strip that shows when it was held.
constexpr double kStripTop = -0.05, kMostStrips = 0.6;  // of the axis

double strip_step(const ProgressPlot& plot) {
  return std::min(0.055, kMostStrips / static_cast<double>(plot.children.size()));
}

double strip_middle(const ProgressPlot& plot, std::size_t child) {
  return kStripTop - strip_step(plot) * (static_cast<double>(child) + 0.5);
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
    const double most = farthest(plot.node.synchronization, sample.limit, sample.least);
    text += fmt::format("{} {} {} {}\n", sample.time, sample.least, std::min(1.0, most),
                        fmt::join(sample.progress, " "));
  }
  return text;
}

// One line for each time that the child was held without a break.
std::string held_lines(const ProgressPlot& plot, std::size_t child) {
  constexpr double kNoBreak = 1e-9;  // seconds
  std::string text;
  std::optional<double> since;
  double until = 0;
  const auto end = [&] {
    if (since) text += fmt::format("{} {} {}\n", *since, until, child);
  };
  for (const ProgressSample& sample : plot.samples) {
    if (sample.held_until[child] <= sample.time) continue;
    if (!since || sample.time - until > kNoBreak) {
      end();
      since = sample.time;
    }
    until = sample.held_until[child];
  }
  end();
  return text;
}

bool is_ever_held(const ProgressPlot& plot, std::size_t child) {
  return !held_lines(plot, child).empty();
}

std::string law(const RecordedNode& node) {
  if (node.delta) return fmt::format("delta = {}", *node.delta);
  if (node.synchronization == Synchronization::Relative) return "delta from an entry";
  if (!node.barriers) return "barriers from an entry";
  return node.barriers->empty() ? "no barriers" : counted(node.barriers->size(), "barrier");
}

std::string caption(const ProgressPlot& plot) {
  std::string what = law(plot.node);
  if (plot.all_children > plot.children.size()) {
    what += fmt::format("; the first {} of {} children", plot.children.size(), plot.all_children);
  }
  return fmt::format("{}   ({})", plot.node.path, what);
}

// It is a quarter of the picture wide; with many children in small letters, and in two columns.
struct Legend {
  int letter = 0;        // height, in pixels
  std::size_t name = 0;  // letters of the longest
};

Legend legend_of(const ProgressPlot& plot, PlotSize size) {
  const auto columns = [&](int letter) {
    const auto entries = static_cast<double>(plot.children.size() + 1);
    return std::ceil(entries * 1.35 * letter / (0.85 * size.height));
  };
  Legend legend{.letter = letter_height(size)};
  if (columns(legend.letter) > 1) legend.letter = kLeastLetter;
  legend.name = letters_in(0.25 * size.width / columns(legend.letter), legend.letter);
  return legend;
}

std::string band_command() {
  return "  data index 0 using 1:2:3 with filledcurves fc rgb '#e4e4e4' fs solid noborder "
         "title 'delta band', \\\n";
}

// The first is the entry of the legend.
std::string barrier_commands(const ProgressPlot& plot) {
  std::string text;
  if (!plot.node.barriers) {
    return "  data index 0 using 1:3 with steps lc rgb '#808080' lw 1 dt 1 title 'barrier', "
           "\\\n";
  }
  const bool many = plot.node.barriers->size() > 12;
  for (const double barrier : *plot.node.barriers) {
    text += fmt::format("  {} with lines lc rgb '{}' lw 0.8 {} {}, \\\n", barrier,
                        many ? "#cccccc" : "#808080", many ? "dt 1" : "dt (6,4)",
                        text.empty() ? "title 'barrier'" : "notitle");
  }
  return text;
}

std::string child_command(const ProgressPlot& plot, std::size_t child, const Legend& legend) {
  return fmt::format("  data index 0 using 1:{} with lines lc {} {} lw 2.2 title {}", child + 4,
                     plot_color(child), plot_dash(child),
                     gnuplot_string(shortened(plot.children[child], legend.name)));
}

// `place`: among the held blocks of the data, which only children that were held have.
std::string held_command(const ProgressPlot& plot, std::size_t child, std::size_t place) {
  const double middle = strip_middle(plot, child), half = 0.31 * strip_step(plot);
  return fmt::format(
      "  data index {} using 1:({:.5g}):1:2:({:.5g}):({:.5g}) with boxxyerror fc {} {} noborder "
      "notitle",
      place + 1, middle, middle - half, middle + half, plot_color(child), plot_fill(child));
}

std::string plot_command(const ProgressPlot& plot, const Legend& legend) {
  std::string text = "plot \\\n";
  text += is_relative(plot) ? band_command() : barrier_commands(plot);
  std::size_t place = 0;
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    text += child_command(plot, child, legend) + (child + 1 < plot.children.size() ? ", \\\n" : "");
  }
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    if (is_ever_held(plot, child)) text += ", \\\n" + held_command(plot, child, place++);
  }
  return text + "\n";
}

// In the middle of the picture: gnuplot's own is in the middle of the axes, beside the legend.
std::string title_commands(const std::string& title) {
  const bool has_two_lines = title.find("\"\\n\"") != std::string::npos;
  return fmt::format("set label {} at screen 0.5, screen 0.955 center noenhanced\nset tmargin {}\n",
                     title, has_two_lines ? 3.6 : 2.4);
}

std::string axes(const ProgressPlot& plot) {
  const std::size_t children = plot.children.size();
  const double bottom = strip_middle(plot, children) + strip_step(plot) / 4;
  const double begin = plot.samples.front().time, end = plot.samples.back().time;
  std::string text = fmt::format("set xrange [{}:{}]\nset yrange [{:.4g}:1.02]\n", begin,
                                 end > begin ? end : begin + 1, bottom);
  text += "set ytics nomirror scale 0.5 0,0.25,1\n";
  text += fmt::format("set label 'held' at graph -0.02, first {:.4g} right\n",
                      (strip_middle(plot, 0) + strip_middle(plot, children - 1)) / 2);
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
  text += title_commands(plot_title(caption(plot), size));
  text += "set samples 2\n";  // a barrier is a straight line: two points, not a hundred
  text += "set xlabel 'time (s)'\nset ylabel 'progress'\n" + axes(plot);
  text +=
      "set xtics nomirror out scale 0.5\n"
      "set grid ytics lt 1 lw 0.6 lc rgb '#e6e6e6'\n"
      "set border 3 lw 0.8 lc rgb '#404040'\n"
      "set xzeroaxis lt 1 lw 0.8 lc rgb '#404040'\n";
  const Legend legend = legend_of(plot, size);
  text += fmt::format("set key outside right top reverse Left samplen 2 noenhanced font ',{}'\n",
                      legend.letter);
  return text + gnuplot_terminal(image, size) + plot_command(plot, legend);
}

PlotResult draw(const ProgressPlot& plot, const std::filesystem::path& image, PlotSize size) {
  return draw(PlotFiles{.directory = image.parent_path(),
                        .stem = image.stem().string(),
                        .data = progress_plot_data(plot),
                        .script = progress_plot_script(plot, image, size),
                        .images = {image.filename().string()}});
}

}  // namespace lockstep
