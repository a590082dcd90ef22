#include "study/plots/progress_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/core/diagnostics.h"
#include "base/core/synchronization.h"
#include "base/core/wording.h"
#include "study/plots/gnuplot.h"
#include "study/plots/plot_style.h"
#include "study/plots/templates.h"

namespace lockstep::host {
namespace {

bool is_relative(const ProgressPlot& plot) {
  return plot.node.synchronization == Synchronization::Relative;
}

std::string sample_lines(const ProgressPlot& plot) {
  std::string text = "# time_s least most_allowed";
  for (const std::string& child : plot.children) text += " " + printable(child);
  if (plot.node.paces) text += ", the factor of each";
  text += "\n";
  for (const ProgressSample& sample : plot.samples) {
    if (sample.begins && &sample != plot.samples.data()) text += "\n";
    const double most = farthest(plot.node.synchronization, sample.limit, sample.least);
    text += fmt::format("{} {} {} {}", sample.time, sample.least, std::min(1.0, most),
                        joined(sample.progress, " "));
    for (const double factor : sample.factor) text += fmt::format(" {}", factor);
    text += "\n";
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

std::string law(const ShapeNode& node) {
  if (!node.resources.empty()) return counted(node.resources.size(), "resource");
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

// How the template shows the limit: the band of delta, a line from the data, or barriers of its
// own.
std::string_view kind_of(const ProgressPlot& plot) {
  if (is_relative(plot)) return "band";
  const bool has_limit = compares_progress(plot.node.synchronization);
  return plot.node.barriers || !has_limit ? "barriers" : "steps";
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
  const std::string title = plot_title(caption(plot), size);
  const Legend legend = legend_of(plot, size);
  const double begin = plot.samples.front().time, end = plot.samples.back().time;
  std::vector<std::string> names, held;
  for (std::size_t child = 0; child < plot.children.size(); ++child) {
    names.push_back(gnuplot_string(shortened(plot.children[child], legend.name)));
    if (!held_lines(plot, child).empty()) held.push_back(std::to_string(child + 1));
  }
  std::string text = "# Made by lockstep. ";
  text += fmt::format("To draw it again: gnuplot {}.gp\n", printable(stem));
  text += fmt::format("data = {}\n", gnuplot_file(stem + ".dat")) + gnuplot_terminal(image, size);
  text += fmt::format("title = {}\ntitle_lines = {}\n", title,
                      title.find("\"\\n\"") == std::string::npos ? 1 : 2);
  text += fmt::format("begin = {}\nend = {}\n", begin, end > begin ? end : begin + 1);
  text += fmt::format("legend_font = ',{}'\nchildren = {}\n", legend.letter, names.size());
  text += fmt::format("array name[children] = [{}]\n", joined(names, ", "));
  text += fmt::format("held = '{}'  # each has a block in the data\n", joined(held, " "));
  text += fmt::format("paces = {}\n", plot.node.paces ? 1 : 0);
  text += fmt::format("kind = '{}'\nbarriers = '{}'\n\n", kind_of(plot),
                      joined(plot.node.barriers.value_or(std::vector<double>()), " "));
  return text + kProgressPlotTemplate;
}

PlotResult draw(const ProgressPlot& plot, const std::filesystem::path& image, PlotSize size) {
  return draw(PlotFiles{.directory = image.parent_path(),
                        .stem = image.stem().string(),
                        .data = progress_plot_data(plot),
                        .script = progress_plot_script(plot, image, size),
                        .images = {image.filename().string()}});
}

}  // namespace lockstep::host
