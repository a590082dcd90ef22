// The plan of a study: the tree with its grid of arguments, how often each cell is run, and what is
// measured. Names and numbers only, as in study.json: no tree is loaded here, so a machine that has
// neither the tree nor its plugins can merge parts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep::host {

struct GridAxis {
  // An <arg> of the tree takes precedence over the study's own names.
  enum class Kind : std::uint8_t { Argument, Seed, Rate };
  Kind kind = Kind::Argument;
  std::string name;
  std::vector<std::string> values = {};
  // It varies together with the axis before it: a cell has the value at the same place of both.
  bool follows = false;

  friend bool operator==(const GridAxis&, const GridAxis&) = default;
};

// One number of each run.
struct StudyColumn {
  std::string measure;  // as --measure spells it
  std::string node;     // the path of the node, or the tree's id for what is of the whole run
  // For the column before: the distance of the run from what was requested.
  bool is_gap = false;
  std::vector<std::uint64_t> cells = {};  // in which the tree has the node; empty: in all

  friend bool operator==(const StudyColumn&, const StudyColumn&) = default;
};

// Part 1 of 4 makes the runs 0, 4, 8, … of each cell.
struct StudyShard {
  std::uint64_t part = 1, of = 1;

  friend bool operator==(const StudyShard&, const StudyShard&) = default;
};

// How far the ends of an interval may be from the value in it, in a cell with --until-ci.
struct Precision {
  double width = 0;
  bool is_percent = false;  // of the value; else in the unit of the measure

  friend bool operator==(const Precision&, const Precision&) = default;
};

// Each run leaves a row of runs.csv, the same compressed, or only a part of the totals of its cell.
enum class StudyRows : std::uint8_t { Csv, Zst, None };
constexpr std::array<std::string_view, 3> kStudyRows{"csv", "zst", "none"};

struct StudyPlan {
  std::string version;  // of lockstep
  std::string tree_file;
  std::string main_tree;                                   // the id
  std::vector<std::pair<std::string, std::string>> files;  // path and text: the tree, its includes
  std::vector<std::pair<std::string, std::string>> plugins;  // name and version
  std::map<std::string, std::string> arguments;              // of the tree, but those of the grid
  std::map<std::string, std::string> values;                 // --set
  std::vector<GridAxis> grid;
  std::uint64_t runs = 0;  // of each cell, all parts together; with a precision, at most
  std::uint64_t seed = 0;
  bool paired = false;                      // the runs of a number have the same seed in all cells
  std::optional<Precision> precision = {};  // at which a cell has enough runs
  double rate = 100;
  std::uint64_t max_ticks = 0;
  std::vector<std::string> measures;
  std::vector<StudyColumn> columns;
  StudyShard shard;
  StudyRows rows = StudyRows::Csv;
};

// The number of cells; the first axis varies slowest. Without an axis there is one cell.
std::uint64_t cell_count(const StudyPlan& plan);
// How many of the last axes vary together; 0 without a grid.
std::size_t last_axes(const std::vector<GridAxis>& grid);
// The value of each axis in a cell.
std::vector<std::string> cell_values(const StudyPlan& plan, std::uint64_t cell);
// "barriers=5, noise=0.01"; "" without a grid.
std::string cell_text(const StudyPlan& plan, std::uint64_t cell);
bool has_column(const StudyColumn& column, std::uint64_t cell);
// In force in a cell: the plan's, or the value of an axis, which must be a number.
std::uint64_t cell_seed(const StudyPlan& plan, std::uint64_t cell);
double cell_rate(const StudyPlan& plan, std::uint64_t cell);

struct StudyRow {
  std::uint64_t cell = 0, run = 0;
};

// How many runs of each cell a part makes.
std::uint64_t runs_of_part(const StudyPlan& plan);
// A part's rows, in their order: cell after cell, and its runs in each. Of a study with a
// precision, those that there may be (row_sequence.h).
std::uint64_t row_count(const StudyPlan& plan);
StudyRow row_at(const StudyPlan& plan, std::uint64_t row);

// The seed of one run, which `lockstep run --seed` takes. It depends only on these, so neither
// threads nor parts change a run: first(first(seed, cell), run), where first(a, b) is the first
// number of stream b of seed a (base/core/random.h). Of a paired study, `cell` is 0 for all cells.
std::uint64_t run_seed(std::uint64_t seed, std::uint64_t cell, std::uint64_t run);
inline std::uint64_t seeding_cell(const StudyPlan& plan, std::uint64_t cell) {
  return plan.paired ? 0 : cell;
}
inline std::uint64_t run_seed(const StudyPlan& plan, StudyRow row) {
  return run_seed(cell_seed(plan, row.cell), seeding_cell(plan, row.cell), row.run);
}

}  // namespace lockstep::host
