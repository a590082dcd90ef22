#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "study/plots/box_plot.h"
#include "study/plots/gnuplot.h"
#include "study/plots/plot_style.h"
#include "study/plots/progress_plot.h"

using namespace lockstep::host;
namespace fs = std::filesystem;

namespace {

class Directory {
 public:
  Directory() {
    std::string name = (fs::temp_directory_path() / "lockstep-plot-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Directory() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The program's search path, for as long as this lives.
class SearchPath {
 public:
  explicit SearchPath(const std::string& value) : before_(std::getenv("PATH")) {
    setenv("PATH", value.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool is_xml(const fs::path& file) {
  return std::system(("xmllint --noout --nonet '" + file.string() + "'").c_str()) == 0;
}

bool is_png(const fs::path& file) {
  return text_of(file).starts_with("\x89PNG\r\n\x1a\n");
}

SampleSummary summary(double middle) {
  return {.count = 5,
          .min = middle - 2,
          .q1 = middle - 1,
          .median = middle,
          .q3 = middle + 1,
          .max = middle + 2,
          .mean = middle + 0.5,
          .median_interval = Interval{middle - 1.5, middle + 0.5}};
}

const ResultCounts kResults{.runs = 5, .of = {4, 1, 0}};

BoxPlot small_plot() {
  BoxPlot plot;
  plot.stem = "small";
  plot.title = "t";
  plot.x_label = "delta";
  plot.y_label = "step length";
  plot.groups = {{"1", summary(3), kResults}, {"0.5", summary(2), kResults}};
  return plot;
}

// Two children; the second is held in the second of three samples.
ProgressPlot small_progress() {
  ProgressPlot plot;
  plot.node.path = "Main/pull";
  plot.node.synchronization = Synchronization::Absolute;
  plot.node.barriers = {0.5, 1};
  plot.children = {"arm", "base"};
  plot.all_children = 2;
  plot.samples = {{0, true, 0, 0.5, {0, 0}, {0, 0}},
                  {0.1, false, 0.25, 0.5, {0.25, 0.5}, {0.1, 0.2}},
                  {0.2, false, 0.5, 1, {0.5, 0.5}, {0.2, 0.2}}};
  return plot;
}

}  // namespace

TEST_CASE("box plots: the last grid name runs along x, the others make plots") {
  std::vector<GridAxis> grid = {{.name = "noise"}, {.name = "barrier_count"}};
  std::vector<SummaryRow> rows;
  for (const std::string noise : {"0", "0.02"}) {
    for (const std::string count : {"0", "5"}) {
      rows.push_back({{noise, count}, "Main/sync", "progress-distance", summary(1), kResults, {}});
      rows.push_back({{noise, count},
                      "Main/sync/task",
                      "predictability:task@0.6=600",
                      summary(2),
                      kResults,
                      0.1});
      rows.push_back({{noise, count}, "Main/sync", "step-length", summary(3), kResults, {}});
    }
  }
  const auto plots = box_plots(grid, rows);
  REQUIRE(plots.size() == 6);
  CHECK(plots[0].stem == "sync-progress-distance-noise_0");
  CHECK(plots[0].title == "Main/sync:  noise = 0  (success 80 %, failure 20 %)");
  CHECK(plots[0].x_label == "barrier_count");
  CHECK(plots[0].y_label == "progress distance");
  REQUIRE(plots[0].groups.size() == 2);
  CHECK(plots[0].groups[0].label == "0");
  CHECK(plots[0].groups[1].label == "5");
  CHECK(plots[1].y_label == "predictability distance at 0.6 (ticks)");
  CHECK(plots[1].groups[1].box->median == 2);
  CHECK(plots[2].y_label == "step length");
  CHECK(plots[4].title == "Main/sync/task:  noise = 0.02  (success 80 %, failure 20 %)");
  grid[1].follows = true;
  const auto together = box_plots(grid, rows);
  REQUIRE(together.size() == 3);
  CHECK(together[0].stem == "sync-progress-distance");
  CHECK(together[0].x_label == "noise:barrier_count");
  REQUIRE(together[0].groups.size() == 4);
  CHECK(together[0].groups[1].label == "0:5");
}

TEST_CASE("box plots: without a grid there is one box, files never share a name") {
  const std::vector<SummaryRow> rows = {{{}, "Main/a/sync", "duration", summary(1), kResults, {}},
                                        {{}, "Main/b/sync", "duration", summary(2), kResults, {}}};
  const auto plots = box_plots({}, rows);
  REQUIRE(plots.size() == 2);
  CHECK(plots[0].groups.size() == 1);
  CHECK(plots[0].stem == "sync-duration");
  CHECK(plots[1].stem == "sync-duration-2");
}

TEST_CASE("box plots: the data are the numbers") {
  BoxPlot plot = small_plot();
  CHECK(box_plot_data(plot) ==
        "# x min q1 median q3 max mean n median-low median-high, and the label at x\n"
        "0 1 2 3 4 5 3.5 5 1.5 3.5 # 1\n"
        "1 0 1 2 3 4 2.5 5 0.5 2.5 # 0.5\n");
  plot.groups[0].box.reset();
  plot.groups[1].box->median_interval.reset();
  CHECK(box_plot_data(plot) ==
        "# x min q1 median q3 max mean n median-low median-high, and the label at x\n"
        "1 0 1 2 3 4 2.5 5 NaN NaN # 0.5\n");
}

TEST_CASE("box plots: the script") {
  const std::string script = box_plot_script(small_plot(), {.width = 360, .height = 240});
  CHECK(contains(script, "set terminal svg noenhanced size 360,240 font 'sans-serif,10' "));
  CHECK(contains(script,
                 "set output './small.svg'\n"
                 "title = 't'\nx_label = 'delta'\ny_label = 'step length'\n"
                 "groups = 2\ncrowded = 0\n"
                 "array group[groups] = ['1', '0.5']\n"
                 "array n[groups] = ['5', '5']\n"
                 "array success[groups] = ['80 %', '80 %']\n"
                 "row_font = ',10'\nset yrange [0:*]\n"));
  CHECK(contains(script, "\nplot \\\n  data using 1:3:2:6:5 with candlesticks"));
  CHECK(script.ends_with("set output './small.png'\nreplot\n"));
}

TEST_CASE("box plots: gnuplot draws them, also when all is 0, below 0 or missing") {
  const Directory directory;
  BoxPlot plot = small_plot();
  SECTION("as they come") {}
  SECTION("all 0") {
    plot.groups = {{"1", SampleSummary{}, kResults}};
  }
  SECTION("below 0") {
    plot.groups = {{"1", summary(-570), kResults}};
  }
  SECTION("no intervals") {
    for (BoxGroup& group : plot.groups) group.box->median_interval.reset();
  }
  SECTION("no box here") {
    plot.groups[0].box.reset();
  }
  const PlotResult result = draw(plot, directory.path());
  CHECK(result.error == "");
  REQUIRE(result.files.size() == 4);
  CHECK(result.files[2] == directory / "small.svg");
  CHECK(is_xml(directory / "small.svg"));
  CHECK(is_png(directory / "small.png"));
}

TEST_CASE("box plots: a legend says what is drawn, rows below what each box is of") {
  const Directory directory;
  BoxPlot plot = small_plot();
  plot.groups[1].results = {.runs = 4, .of = {3, 1, 0}};
  plot.groups.push_back({"0.1", std::nullopt, {.runs = 7, .of = {0, 0, 7}}});
  REQUIRE(draw(plot, directory.path()).error == "");
  const std::string svg = text_of(directory / "small.svg");
  for (const char* text : {">quartiles<", ">median<", ">95 % of median<", ">min, max<", ">mean<",
                           ">n<", ">success<", ">80 %<", ">75 %<", ">5<", ">0 %<"}) {
    CAPTURE(text);
    CHECK(contains(svg, text));
  }
}

TEST_CASE("plots: as many lines as there are styles can be told apart") {
  const Directory directory;
  ProgressPlot plot = small_progress();
  plot.children.clear();
  for (std::size_t child = 0; child < kPlotStyles; ++child) {
    plot.children.push_back("child" + std::to_string(child));
  }
  for (ProgressSample& sample : plot.samples) {
    sample.progress.assign(kPlotStyles, sample.least);
    sample.held_until.assign(kPlotStyles, sample.time + 0.1);
  }
  REQUIRE(draw(plot, directory / "x.svg").error == "");
  const std::string svg = text_of(directory / "x.svg");
  std::set<std::string> lines;
  for (const std::string& child : plot.children) {
    const auto line = svg.find("<path stroke=", svg.find("<title>" + child + "</title>"));
    REQUIRE(line != std::string::npos);
    lines.insert(svg.substr(line, svg.find(" d=", line) - line));
  }
  CHECK(lines.size() == kPlotStyles);
  std::set<std::string> patterns;
  for (auto at = svg.find("<pattern "); at != std::string::npos; at = svg.find("<pattern ", at)) {
    at = svg.find('>', at);
    patterns.insert(svg.substr(at, svg.find("</pattern>", at) - at));
  }
  CHECK(patterns.size() == kPlotStyles - 6);
}

TEST_CASE("plots: a long title has two lines, a longer one loses its beginning") {
  const PlotSize size;
  CHECK(plot_title("Main/pull", size) == "'Main/pull'");
  const std::string path = "Main/" + std::string(60, 'a') + "/pull   (2 barriers)";
  CHECK(plot_title(path, size) ==
        "'Main/" + std::string(60, 'a') + "/pull'.\"\\n\".'(2 barriers)'");
  const std::string longer = plot_title(std::string(300, 'a') + "/" + path, size);
  CHECK(longer.starts_with("'…aaa"));
  CHECK(longer.ends_with("aaa/pull   (2 barriers)'"));
  CHECK(contains(longer, "'.\"\\n\".'"));
  CHECK(shortened("äöü/äöü", 4) == "…äöü");
  CHECK(shortened("äöü", 3) == "äöü");
  const std::string narrow = plot_title(path, {.width = 360, .height = 240});
  CHECK(narrow.size() < longer.size());
}

TEST_CASE("plots: letters are smaller in a small picture, not in a large one") {
  CHECK(letter_height({}) == 15);
  CHECK(letter_height({.width = 1440, .height = 864}) == 15);
  CHECK(letter_height({.width = 600, .height = 432}) == 13);
  CHECK(letter_height({.width = 360, .height = 240}) == 10);
}

TEST_CASE("plots: any text is drawn as it is, and run by nobody") {
  const Directory directory;
  BoxPlot plot = small_plot();
  const std::string mark = (directory / "mark").string();
  plot.title = "it's `touch " + mark + "` \"$(touch " + mark + ")\" @x {/Bold y}_z \\";
  plot.x_label = "';system('touch " + mark + "');'";
  plot.y_label = "`touch " + mark + "` \" @x $y \\";
  plot.groups[0].label = "a\nb\x1b 50%d %";
  const PlotResult result = draw(plot, directory.path());
  CHECK(result.error == "");
  CHECK(!fs::exists(mark));
  const std::string svg = text_of(directory / "small.svg");
  CHECK(contains(svg, "it's `touch "));
  CHECK(contains(svg, ">';system('touch "));
  CHECK(contains(svg, ">`touch "));
  CHECK(contains(svg, "` &quot; @x $y \\<") != contains(svg, "` \" @x $y \\<"));
  CHECK(contains(svg, "@x {/Bold y}_z \\"));
  CHECK(contains(svg, "a\\x0Ab\\x1B 50%d %<"));
}

TEST_CASE("plots: no name of a file is a command") {
  const Directory directory;
  for (const std::string stem : {"<touch mark", "|touch mark", "-", "it's"}) {
    const PlotResult result = draw(small_progress(), directory / (stem + ".svg"));
    CHECK(result.error == "");
    CHECK(text_of(directory / (stem + ".svg")).starts_with("<?xml"));
  }
  CHECK(!fs::exists(directory / "mark"));
}

TEST_CASE("plots: without gnuplot there is the data, and the name of the package") {
  const Directory directory;
  PlotResult result;
  {
    const SearchPath nothing(directory.path().string());
    result = draw(small_plot(), directory.path());
  }
  CHECK(result.gnuplot_missing);
  CHECK(contains(result.error, "'gnuplot-nox'"));
  CHECK(result.files == std::vector<fs::path>{directory / "small.dat", directory / "small.gp"});
  CHECK(text_of(directory / "small.dat") == box_plot_data(small_plot()));
  CHECK(!fs::exists(directory / "small.svg"));
}

TEST_CASE("plots: what gnuplot says of an error is reported, and no half image stays") {
  const Directory directory;
  const PlotResult result = draw(PlotFiles{.directory = directory.path(),
                                           .stem = "bad",
                                           .data = "",
                                           .script = "set terminal svg\nset output 'bad.svg'\n"
                                                     "plot sin(x)\nplot sin(x) bogus\n",
                                           .images = {"bad.svg"}});
  CHECK(!result.gnuplot_missing);
  CHECK(contains(result.error, "gnuplot failed:\n"));
  CHECK(contains(result.error, "\"./bad.gp\" line 4: unexpected or unrecognized token"));
  CHECK(!fs::exists(directory / "bad.svg"));
}

TEST_CASE("plots: what was drawn before stays until there is a new picture, and nothing else") {
  const Directory directory;
  REQUIRE(draw(small_plot(), directory.path()).ok());
  const std::string before = text_of(directory / "small.svg");
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(directory.path())) {
      names.insert(file.path().filename().string());
    }
    return names;
  };
  const std::set<std::string> all{"small.dat", "small.gp", "small.png", "small.svg"};
  CHECK(files() == all);
  const PlotResult bad = draw(PlotFiles{.directory = directory.path(),
                                        .stem = "small",
                                        .data = "1 2\n",
                                        .script = "set terminal svg\nset output 'small.svg'\n"
                                                  "plot sin(x) bogus\n",
                                        .images = {"small.svg"}});
  CHECK(!bad.ok());
  CHECK(text_of(directory / "small.svg") == before);
  CHECK(files() == all);
}

TEST_CASE("plots: a link in the place of a file is replaced, never followed") {
  const Directory directory;
  std::ofstream(directory / "precious") << "kept";
  for (const char* name : {"small.dat", "small.gp", "small.svg", "small.png"}) {
    fs::create_symlink(directory / "precious", directory / name);
  }
  CHECK(draw(small_plot(), directory.path()).ok());
  CHECK(text_of(directory / "precious") == "kept");
  CHECK(is_xml(directory / "small.svg"));
}

TEST_CASE("plots: a directory that is not there is reported") {
  const Directory directory;
  const PlotResult result = draw(small_plot(), directory / "none");
  CHECK(contains(result.error, "small.dat': No such file or directory"));
  CHECK(!result.gnuplot_missing);
}

TEST_CASE("progress plot: the data are the samples, and when each child was held") {
  ProgressPlot plot = small_progress();
  CHECK(progress_plot_data(plot) ==
        "# time_s least most_allowed arm base\n"
        "0 0 0.5 0 0\n"
        "0.1 0.25 0.5 0.25 0.5\n"
        "0.2 0.5 1 0.5 0.5\n"
        "\n\n"
        "# base is held: from_s to_s child\n"
        "0.1 0.2 1\n");
  plot.node.synchronization = Synchronization::Relative;
  plot.node.delta = 0.7;
  plot.samples[1].held_until = {0.1, 0.1};
  plot.samples[2] = {0.4, true, 0.5, 0.7, {0.5, 0.5}, {0.4, 0.4}};
  plot.samples[0].limit = plot.samples[1].limit = 0.7;
  CHECK(progress_plot_data(plot) ==
        "# time_s least most_allowed arm base\n"
        "0 0 0.7 0 0\n"
        "0.1 0.25 0.95 0.25 0.5\n"
        "\n"
        "0.4 0.5 1 0.5 0.5\n");
}

TEST_CASE("progress plot: the script draws barriers or the band of delta") {
  ProgressPlot plot = small_progress();
  const auto script = [&] { return progress_plot_script(plot, "x.svg", {}); };
  const Directory directory;
  const auto picture = [&] {
    CHECK(draw(plot, directory / "x.svg").error == "");
    return text_of(directory / "x.svg");
  };
  const auto bars = [](const std::string& svg) {
    std::size_t count = 0;
    for (auto at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1))
      ++count;
    return count;
  };
  CHECK(contains(script(),
                 "title = 'Main/pull   (2 barriers)'\ntitle_lines = 1\nbegin = 0\nend = 0.2\n"));
  CHECK(contains(script(), "children = 2\narray name[children] = ['arm', 'base']\nheld = '2' "));
  CHECK(contains(script(), "kind = 'barriers'\nbarriers = '0.5 1'\n"));
  std::string svg = picture();
  CHECK(contains(svg, ">barrier<"));
  CHECK(!contains(svg, ">delta band<"));
  CHECK(bars(svg) == 1);  // when the base was held
  plot.node.barriers.reset();
  CHECK(contains(picture(), ">barrier<"));
  plot.node.barriers.emplace();
  plot.samples[1].held_until = {0.1, 0.1};
  svg = picture();
  CHECK(!contains(svg, ">barrier<"));
  CHECK(bars(svg) == 0);
  plot.node.synchronization = Synchronization::Relative;
  plot.node.delta = 0.1;
  CHECK(contains(script(), "title = 'Main/pull   (delta = 0.1)'\n"));
  svg = picture();
  CHECK(contains(svg, ">delta band<"));
  CHECK(!contains(svg, ">barrier<"));
}

TEST_CASE("progress plot: of more children than there are styles the first are drawn") {
  ProgressPlot plot = small_progress();
  plot.all_children = 40;
  CHECK(contains(progress_plot_script(plot, "x.svg", {}),
                 "'Main/pull   (2 barriers; the first 2 of 40 children)'"));
}

TEST_CASE("progress plot: the longest names, in the smallest picture, are drawn") {
  const Directory directory;
  ProgressPlot plot = small_progress();
  plot.node.path = std::string(100'000, '/');
  plot.children = {std::string(100'000, '\''), std::string(100'000, '\xff')};
  const PlotSize smallest{.width = PlotSize::kLeastWidth, .height = PlotSize::kLeastHeight};
  const PlotResult result = draw(plot, directory / "x.svg", smallest);
  CHECK(result.error == "");
  CHECK(is_xml(directory / "x.svg"));
  CHECK(fs::file_size(directory / "x.gp") < 10'000);
}
