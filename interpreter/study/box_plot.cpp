#include "study/box_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/diagnostics.h"
#include "measure/measure_spec.h"
#include "study/gnuplot.h"

namespace lockstep {
namespace {

constexpr double kGroupWidth = 0.7;  // of the distance of two groups

std::string measure_label(const std::string& text) {
  std::string error;
  const auto measure = parse_measure(text, error);
  if (!measure) return text;
  if (measure->kind != MeasureKind::Predictability) return std::string(axis_label(measure->kind));
  if (!measure->expected) return fmt::format("instant of progress {} (ticks)", measure->progress);
  return fmt::format("predictability distance at {} (ticks)", measure->progress);
}

// What the plot is of, beside the grid name along x.
BoxPlot empty_plot(std::span<const std::string> names, const SummaryRow& row) {
  BoxPlot plot;
  plot.stem = last_segment(row.node) + "-" + row.measure;
  plot.title = row.node;
  for (std::size_t name = 0; name + 1 < names.size(); ++name) {
    plot.stem += "-" + names[name] + "_" + row.grid[name];
    plot.title += fmt::format("{}{} = {}", name == 0 ? ":  " : ", ", names[name], row.grid[name]);
  }
  plot.stem = file_stem(plot.stem);
  if (!names.empty()) plot.x_label = names.back();
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

template <class Use>
void for_each_box(const BoxPlot& plot, Use use) {
  for (const BoxGroup& group : plot.groups) {
    for (const auto& box : group.boxes) {
      if (box) use(*box);
    }
  }
}

// 0 is always in sight; all equal to 0 would leave gnuplot without a range.
std::string y_range(const BoxPlot& plot) {
  double least = 0, most = 0;
  for_each_box(plot, [&](const SampleSummary& box) {
    least = std::min(least, box.min);
    most = std::max(most, box.max);
  });
  if (least == 0 && most == 0) return "[0:1]";
  return fmt::format("[{}:{}]", least < 0 ? "*" : "0", most > 0 ? "*" : "0");
}

// The text of a tic is a format.
std::string tic_text(std::string_view label) {
  std::string text;
  for (const char c : label) text.append(c == '%' ? 2 : 1, c);
  return gnuplot_string(text);
}

std::string x_tics(const BoxPlot& plot) {
  std::string tics;
  std::size_t letters = 0;
  for (std::size_t group = 0; group < plot.groups.size(); ++group) {
    letters += plot.groups[group].label.size() + 2;
    tics +=
        fmt::format("{}{} {}", group == 0 ? "" : ", ", tic_text(plot.groups[group].label), group);
  }
  const bool crowded = letters > 64;
  return fmt::format("set xtics nomirror scale 0{} ({})\n", crowded ? " rotate by -35" : "", tics);
}

// The box, its median, its mean.
std::string series_commands(const BoxPlot& plot, std::size_t series) {
  const auto color = plot_color(series);
  const bool legend = plot.series.size() > 1;
  const std::string title = legend ? "title " + gnuplot_string(plot.series[series]) : "notitle";
  return fmt::format(
      "  data index {0} using 1:3:2:6:5 with candlesticks whiskerbars 0.5 lc rgb '{1}' lw 1.4 {2}, "
      "\\\n"
      "  data index {0} using ($1-width/2):4:(width):(0) with vectors nohead lc rgb '{1}' lw 3 "
      "notitle, \\\n"
      "  data index {0} using 1:7 with points pt 7 ps 0.75 lc rgb 'white' notitle, \\\n"
      "  data index {0} using 1:7 with points pt 6 ps 0.75 lw 1.4 lc rgb '{1}' notitle",
      series, color, title);
}

double box_width(const BoxPlot& plot) {
  return kGroupWidth / static_cast<double>(std::max<std::size_t>(plot.series.size(), 1));
}

}  // namespace

std::vector<BoxPlot> box_plots(std::span<const std::string> grid_names,
                               std::span<const SummaryRow> rows) {
  std::vector<BoxPlot> plots;
  using Key = std::vector<std::string>;
  std::map<Key, std::size_t> places;
  for (const SummaryRow& row : rows) {
    Key key(row.grid.begin(), row.grid.end() - (row.grid.empty() ? 0 : 1));
    key.insert(key.end(), {row.node, row.measure});
    const auto [place, is_new] = places.emplace(std::move(key), plots.size());
    if (is_new) plots.push_back(empty_plot(grid_names, row));
    const std::string label = row.grid.empty() ? "" : row.grid.back();
    const bool is_there = row.summary.count > 0;
    BoxPlot& plot = plots[place->second];
    plot.groups.push_back({label, {is_there ? std::optional(row.summary) : std::nullopt}});
    plot.results = plot.results + row.results;
  }
  for (BoxPlot& plot : plots) plot.title += "  (" + to_text(plot.results) + ")";
  make_unique(plots);
  return plots;
}

std::string box_plot_data(const BoxPlot& plot) {
  std::string text = "# x min q1 median q3 max mean n, and what stands at x\n";
  const double width = box_width(plot);
  for (std::size_t series = 0; series < plot.series.size(); ++series) {
    if (series > 0) text += "\n\n";
    text += fmt::format("# {}\n", printable(plot.series[series]));
    const double offset =
        width * (static_cast<double>(series) - (static_cast<double>(plot.series.size()) - 1) / 2);
    for (std::size_t group = 0; group < plot.groups.size(); ++group) {
      const auto& boxes = plot.groups[group].boxes;
      if (series >= boxes.size() || !boxes[series]) continue;
      const SampleSummary& box = *boxes[series];
      text += fmt::format("{:.6g} {} {} {} {} {} {} {} # {}\n", static_cast<double>(group) + offset,
                          box.min, box.q1, box.median, box.q3, box.max, box.mean, box.count,
                          printable(plot.groups[group].label));
    }
  }
  return text;
}

std::string box_plot_script(const BoxPlot& plot, PlotSize size) {
  std::string text = "# Made by lockstep. Box: quartiles; line: median; whiskers: minimum and ";
  text += fmt::format("maximum; circle: mean.\n# To draw it again: gnuplot {}.gp\n", plot.stem);
  text += fmt::format("data = {}\nset encoding utf8\n", gnuplot_file(plot.stem + ".dat"));
  text += fmt::format("set title {} noenhanced\n", gnuplot_string(plot.title));
  text += fmt::format("set xlabel {} noenhanced\n", gnuplot_string(plot.x_label));
  text += fmt::format("set ylabel {} noenhanced\n", gnuplot_string(plot.y_label));
  text += x_tics(plot);
  text += fmt::format("set xrange [-0.6:{}]\n", static_cast<double>(plot.groups.size()) - 0.4);
  text += fmt::format("set yrange {}\n", y_range(plot));
  text +=
      "set ytics nomirror scale 0.5\n"
      "set grid ytics lt 1 lw 0.6 lc rgb '#dcdcdc'\n"
      "set border 3 lw 0.8 lc rgb '#404040'\n"
      "set xzeroaxis lt 1 lw 0.8 lc rgb '#404040'\n"
      "set key tmargin center horizontal reverse Left samplen 1.5 noenhanced\n"
      "set style fill solid 0.25 border\n";
  text += fmt::format("width = {:.4g}\nset boxwidth width\n", 0.75 * box_width(plot));
  text += gnuplot_terminal(plot.stem + ".svg", size) + "plot \\\n";
  for (std::size_t series = 0; series < plot.series.size(); ++series) {
    text += series_commands(plot, series) + (series + 1 < plot.series.size() ? ", \\\n" : "\n");
  }
  text += gnuplot_terminal(plot.stem + ".png", size) + "replot\n";
  return text;
}

PlotResult draw(const BoxPlot& plot, const std::filesystem::path& directory, PlotSize size) {
  return draw(PlotFiles{.directory = directory,
                        .stem = plot.stem,
                        .data = box_plot_data(plot),
                        .script = box_plot_script(plot, size),
                        .images = {plot.stem + ".svg", plot.stem + ".png"}});
}

}  // namespace lockstep
