#include "study/plots/box_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/core/utf8.h"
#include "base/core/wording.h"
#include "judge/measure/measure_spec.h"
#include "study/plots/gnuplot.h"
#include "study/plots/plot_style.h"
#include "study/plots/templates.h"
#include "trace/shape.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kLongestLabel = 24;

std::string measure_label(const std::string& text) {
  const auto measure = parse_measure(text);
  return measure ? axis_label(*measure) : text;
}

// A plot without boxes: its titles, and what stays the same along x.
BoxPlot empty_plot(const std::vector<GridAxis>& grid, const SummaryRow& row) {
  BoxPlot plot;
  plot.stem = last_segment(row.node) + "-" + row.measure;
  plot.title = row.node;
  const std::size_t last = grid.size() - last_axes(grid);
  for (std::size_t axis = 0; axis < last; ++axis) {
    const std::string& name = grid[axis].name;
    plot.stem += "-" + name + "_" + row.grid[axis];
    plot.title += fmt::format("{}{} = {}", axis == 0 ? ":  " : ", ", name, row.grid[axis]);
  }
  plot.stem = file_stem(plot.stem);
  for (std::size_t axis = last; axis < grid.size(); ++axis) {
    plot.x_label += (axis == last ? "" : ":") + grid[axis].name;
  }
  plot.y_label = measure_label(row.measure);
  return plot;
}

void make_unique(std::vector<BoxPlot>& plots) {
  std::set<std::string> taken;
  for (BoxPlot& plot : plots) {
    const std::string stem = plot.stem;
    for (int number = 2; !taken.insert(plot.stem).second; ++number) {
      plot.stem = fmt::format("{}-{}", stem, number);
    }
  }
}

// 0 is always in sight; all equal to 0 would leave gnuplot without a range.
std::string y_range(const BoxPlot& plot) {
  double least = 0, most = 0;
  for (const BoxGroup& group : plot.groups) {
    if (!group.box) continue;
    least = std::min(least, group.box->min);
    most = std::max(most, group.box->max);
  }
  if (least == 0 && most == 0) return "[0:1]";
  return fmt::format("[{}:{}]", least < 0 ? "*" : "0", most > 0 ? "*" : "0");
}

// The text of a tic is a format.
std::string tic_text(std::string_view label) {
  std::string text;
  for (const char c : shortened(label, kLongestLabel)) text.append(c == '%' ? 2 : 1, c);
  return gnuplot_string(text);
}

std::string n_of(const BoxGroup& group) {
  return fmt::format("{}", group.box ? group.box->count : 0);
}

std::string success_of(const BoxGroup& group) {
  const auto success = static_cast<std::size_t>(StudyResult::Success);
  return percent(group.results.of[success], group.results.runs);
}

// A plot of many groups has smaller letters, in pixels, so that they stay apart.
int row_letters(const BoxPlot& plot, PlotSize size) {
  std::size_t longest = 1;
  for (const BoxGroup& group : plot.groups) {
    longest = std::max({longest, n_of(group).size(), success_of(group).size()});
  }
  const double of_group = 0.85 * size.width / static_cast<double>(plot.groups.size());
  return std::clamp(static_cast<int>(of_group / (0.6 * static_cast<double>(longest + 1))), 4,
                    letter_height(size));
}

}  // namespace

std::vector<BoxPlot> box_plots(const std::vector<GridAxis>& grid,
                               std::span<const SummaryRow> rows) {
  const auto along_x = static_cast<std::ptrdiff_t>(last_axes(grid));
  std::vector<BoxPlot> plots;
  using Key = std::vector<std::string>;
  std::map<Key, std::size_t> places;
  for (const SummaryRow& row : rows) {
    const auto last = row.grid.end() - along_x;
    Key key(row.grid.begin(), last);
    key.insert(key.end(), {row.node, row.measure});
    const auto [place, is_new] = places.emplace(std::move(key), plots.size());
    if (is_new) plots.push_back(empty_plot(grid, row));
    const std::string label = joined(std::span(last, row.grid.end()), ":");
    const bool is_there = row.summary.count > 0;
    BoxPlot& plot = plots[place->second];
    plot.groups.push_back(
        {label, is_there ? std::optional(row.summary) : std::nullopt, row.results});
    plot.results = plot.results + row.results;
  }
  for (BoxPlot& plot : plots) plot.title += "  (" + to_text(plot.results) + ")";
  make_unique(plots);
  return plots;
}

std::string box_plot_data(const BoxPlot& plot) {
  std::string text = "# x min q1 median q3 max mean n median-low median-high, and the label at x\n";
  for (std::size_t group = 0; group < plot.groups.size(); ++group) {
    if (!plot.groups[group].box) continue;
    const SampleSummary& box = *plot.groups[group].box;
    text += fmt::format("{} {} {} {} {} {} {} {}", group, box.min, box.q1, box.median, box.q3,
                        box.max, box.mean, box.count);
    text += box.median_interval
                ? fmt::format(" {} {}", box.median_interval->low, box.median_interval->high)
                : " NaN NaN";
    text += fmt::format(" # {}\n", printable(plot.groups[group].label));
  }
  return text;
}

std::string box_plot_script(const BoxPlot& plot, PlotSize size) {
  const std::size_t letters = letters_in(0.7 * size.width, letter_height(size));
  std::vector<std::string> groups, n, success;
  std::size_t length = 0;
  for (const BoxGroup& group : plot.groups) {
    groups.push_back(tic_text(group.label));
    length += columns(groups.back());
    n.push_back(gnuplot_string(n_of(group)));
    success.push_back(gnuplot_string(success_of(group)));
  }
  std::string text = "# Made by lockstep. Box: quartiles; line: median; whiskers: minimum and ";
  text += fmt::format(
      "maximum; circle: mean; bar: median, 95 % interval.\n# To draw it again: gnuplot {}.gp\n",
      plot.stem);
  text += fmt::format("data = {}\n", gnuplot_file(plot.stem + ".dat"));
  text += gnuplot_terminal(plot.stem + ".svg", size);
  text +=
      fmt::format("title = {}\nx_label = {}\ny_label = {}\n", plot_title(plot.title, size),
                  gnuplot_string(shortened(plot.x_label, letters)), gnuplot_string(plot.y_label));
  text += fmt::format("groups = {}\ncrowded = {:d}\n", groups.size(), length > 64);
  text += fmt::format("array group[groups] = [{}]\n", joined(groups, ", "));
  text += fmt::format("array n[groups] = [{}]\n", joined(n, ", "));
  text += fmt::format("array success[groups] = [{}]\n", joined(success, ", "));
  text +=
      fmt::format("row_font = ',{}'\nset yrange {}\n\n", row_letters(plot, size), y_range(plot));
  return text + kBoxPlotTemplate + gnuplot_terminal(plot.stem + ".png", size) + "replot\n";
}

PlotResult draw(const BoxPlot& plot, const std::filesystem::path& directory, PlotSize size) {
  return draw(PlotFiles{.directory = directory,
                        .stem = plot.stem,
                        .data = box_plot_data(plot),
                        .script = box_plot_script(plot, size),
                        .images = {plot.stem + ".svg", plot.stem + ".png"}});
}

}  // namespace lockstep::host
