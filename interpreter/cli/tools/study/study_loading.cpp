#include "cli/tools/study/study_loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "base/compression/whole_frame.h"
#include "base/core/suggest.h"
#include "base/core/version.h"
#include "base/core/wording.h"
#include "base/system/freed_memory.h"
#include "cli/checks.h"
#include "cli/exit_code.h"
#include "cli/load/real_time_leaves.h"
#include "judge/measure/measure_spec.h"
#include "run/shape_of.h"
#include "study/column_names.h"
#include "study/grid_text.h"
#include "study/plan_check.h"
#include "study/precision.h"

namespace lockstep::host {
namespace {

constexpr double kRate = 100;  // Hz

// Splits texts of the form "name=value".
std::map<std::string, std::string> pairs(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> pairs;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals != std::string::npos) pairs[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return pairs;
}

class StudyLoader {
 public:
  StudyLoader(const StudyOptions& options, LoadedStudy& study, Diagnostics& diagnostics)
      : options_(options), study_(study), diagnostics_(diagnostics) {}

  int load();

 private:
  void error(std::string message, std::string hint = {}) {
    diagnostics_.error("bad-study"_code, {}, std::move(message), std::move(hint));
  }
  void read_measures();
  void read_shard();
  void read_precision();
  void read_rows();
  void parse_grids();
  void read_grid(const std::vector<DeclaredArgument>& declared);
  void read_axis(GridAxis& axis, const std::vector<DeclaredArgument>& declared);
  void name_axis(GridAxis& axis, const std::vector<DeclaredArgument>& declared);
  void check_values(const GridAxis& axis);
  int load_cell(std::uint64_t number);
  void add_files(const Project& project);
  void add_columns(StudyCell& cell, std::uint64_t number);
  Arguments first_arguments() const;

  const StudyOptions& options_;
  LoadedStudy& study_;
  Diagnostics& diagnostics_;
  std::vector<std::vector<GridAxis>> grids_;  // of each --grid
  std::set<std::string> files_;
  std::map<std::string, std::size_t> columns_;  // of the plan, by name
  bool warned_of_real_time_ = false;
};

void StudyLoader::read_measures() {
  std::vector<std::string> texts = options_.measures;
  if (texts.empty()) texts.emplace_back("progress-distance");
  for (const std::string& text : texts) {
    const auto measure = parse_measure(text);
    if (!measure) {
      error(fmt::format("--measure {}: {}", text, measure.error().message));
    } else if (std::ranges::find(study_.measures, *measure) == study_.measures.end()) {
      study_.measures.push_back(*measure);
      study_.plan.measures.push_back(to_text(*measure));
    }
  }
}

void StudyLoader::read_shard() {
  if (options_.shard.empty()) return;
  const std::string_view text = options_.shard;
  const auto slash = std::min(text.find('/'), text.size() - 1);
  const auto part = count_from(text.substr(0, slash)), of = count_from(text.substr(slash + 1));
  if (!part || !of || *part < 1 || *part > *of) {
    error(fmt::format("--shard {}: expected I/N with I from 1 to N", options_.shard));
  } else if (*of > options_.runs) {
    error(fmt::format("--shard {}: {} runs cannot be made in {} parts", options_.shard,
                      options_.runs, *of));
  } else {
    study_.plan.shard = {*part, *of};
  }
}

void StudyLoader::read_precision() {
  if (!options_.until_ci) return;
  study_.plan.precision = precision_from(*options_.until_ci);
  if (!study_.plan.precision) {
    error(fmt::format("--until-ci {}: expected a width above 0", *options_.until_ci),
          "such as 5%, of the median, or 0.5, in the unit of the measure");
  } else if (study_.plan.shard.of != 1) {
    error("--until-ci: such a study has no parts, since all runs of a cell decide when it ends",
          "leave out --shard");
  }
}

void StudyLoader::read_rows() {
  const auto rows = std::ranges::find(kStudyRows, options_.rows) - kStudyRows.begin();
  study_.plan.rows = static_cast<StudyRows>(rows);
  if (study_.plan.rows == StudyRows::None && study_.plan.precision) {
    error("--rows none: with --until-ci the values of all runs of a cell decide when it ends",
          "leave out one of the two");
  }
  if (study_.plan.rows != StudyRows::Zst) return;
  try {
    zstd_frame("");
  } catch (const std::runtime_error& missing) {
    error(fmt::format("--rows zst: {}", missing.what()));
  }
}

void StudyLoader::name_axis(GridAxis& axis, const std::vector<DeclaredArgument>& declared) {
  std::vector<std::string_view> names;
  for (const DeclaredArgument& argument : declared) names.push_back(argument.name);
  names.insert(names.end(), {"seed", "rate"});
  const auto found = std::ranges::find(names, axis.name) - names.begin();
  const auto count = std::ssize(declared);
  if (found == std::ssize(names)) {
    std::string hint = did_you_mean(axis.name, names);
    if (!hint.empty()) hint += ' ';
    hint += fmt::format("there are: '{}'", joined(names, "', '"));
    error(fmt::format("unknown name '{}' in --grid", axis.name), std::move(hint));
  } else if (found >= count) {
    axis.kind = found == count ? GridAxis::Kind::Seed : GridAxis::Kind::Rate;
  }
}

void StudyLoader::check_values(const GridAxis& axis) {
  for (const std::string& value : axis.values) {
    if (value.find_first_of("\r\n") != std::string::npos) {
      error(fmt::format("--grid {}: a value has several lines", axis.name));
    }
    if (axis.kind == GridAxis::Kind::Seed) {
      if (const auto wrong = check_count(value); !wrong.empty()) error("--grid seed: " + wrong);
    }
    if (axis.kind == GridAxis::Kind::Rate && !rate_from(value)) {
      error(fmt::format("--grid rate: '{}' is not a number from {} to {}", value, kLeastRate,
                        kMostRate));
    }
  }
}

void StudyLoader::read_axis(GridAxis& axis, const std::vector<DeclaredArgument>& declared) {
  const auto is_same = [&](const GridAxis& other) { return other.name == axis.name; };
  if (std::ranges::any_of(study_.plan.grid, is_same))
    error(fmt::format("--grid {}: given twice", axis.name));
  for (const std::string& pair : options_.load.arguments) {
    if (pair.starts_with(axis.name + '='))
      error(fmt::format("'{}' is given both by --grid and by --arg", axis.name));
  }
  name_axis(axis, declared);
  check_values(axis);
}

void StudyLoader::parse_grids() {
  for (const std::string& text : options_.grid) {
    auto axes = parse_grid(text);
    if (axes) {
      if (const auto twice = value_twice(*axes); !twice.empty())
        error(fmt::format("--grid {}: the value '{}' is given twice", axes->front().name, twice));
      grids_.push_back(std::move(*axes));
    } else {
      error(axes.error().message, axes.error().hint);
    }
  }
}

void StudyLoader::read_grid(const std::vector<DeclaredArgument>& declared) {
  StudyPlan& plan = study_.plan;
  for (auto& axes : grids_) {
    for (GridAxis& axis : axes) read_axis(axis, declared);
    plan.grid.insert(plan.grid.end(), axes.begin(), axes.end());
  }
  if (auto wrong = check_size(plan); !wrong.empty()) {
    error(std::move(wrong));
  } else if (cell_count(plan) > kMostCells) {
    error(
        fmt::format("the grid has {} cells, at most {} are allowed", cell_count(plan), kMostCells));
  }
}

void StudyLoader::add_files(const Project& project) {
  for (const auto& source : project.sources.all()) {
    if (!files_.insert(source->path()).second) continue;
    study_.plan.files.emplace_back(source->path(), source->text());
  }
}

void StudyLoader::add_columns(StudyCell& cell, std::uint64_t number) {
  const RunMeasures measures(shape_of(cell.tree), study_.measures, cell.rate);
  if (!measures.error().empty()) {
    const std::string where = cell_text(study_.plan, number);
    return error(fmt::format("--measure: {}{}{}", measures.error(),
                             where.empty() ? "" : ", in the cell ", where),
                 "`lockstep show` draws the tree");
  }
  auto& columns = study_.plan.columns;
  for (const StudyColumn& column : measures.columns()) {
    const auto [place, is_new] = columns_.try_emplace(column_name(column), columns.size());
    if (is_new) columns.push_back(column);
    columns[place->second].cells.push_back(number);
    cell.columns.push_back(place->second);
  }
}

int StudyLoader::load_cell(std::uint64_t number) {
  StudyPlan& plan = study_.plan;
  LoadCommandOptions options = options_.load;
  options.main_file = MainFile::IsRegular;  // it is read for every cell
  const auto values = cell_values(plan, number);
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    if (plan.grid[axis].kind != GridAxis::Kind::Argument) continue;
    options.arguments.push_back(plan.grid[axis].name + '=' + values[axis]);
  }
  if (!study_.leaves.empty()) options.unknown = MissingNodes::AreMocked;
  auto loaded = load_given(options_.tree, options, diagnostics_, study_.plugins);
  if (!loaded) return exit_code_of(loaded.error());
  add_files(*loaded->project);
  if (!study_.leaves.empty()) study_.leaves.take_over(loaded->definition);
  study_.cells.push_back(
      {make_runnable(std::move(*loaded)).tree, cell_rate(plan, number), cell_seed(plan, number)});
  return_freed_memory();
  if (!study_.leaves.empty() && !study_.leaves.give(study_.cells.back().tree)) return kExitUsage;
  if (!warned_of_real_time_) {
    warned_of_real_time_ = warn_of_real_time_leaves(
        study_.cells.back().tree, options_.tree,
        "the numbers mean little; a study needs leaves that work in ticks", diagnostics_);
  }
  add_columns(study_.cells.back(), number);
  if (number == 0) plan.main_tree = study_.cells.front().tree.id;
  return kExitSuccess;
}

// As many as there can be known before the grid is.
Arguments StudyLoader::first_arguments() const {
  Arguments arguments;
  for (const auto& [name, value] : pairs(options_.load.arguments)) arguments[name] = value;
  for (const auto& axes : grids_) {
    for (const GridAxis& axis : axes) arguments[axis.name] = axis.values.front();
  }
  return arguments;
}

int StudyLoader::load() {
  StudyPlan& plan = study_.plan;
  plan.version = kVersion;
  plan.tree_file = options_.tree;
  plan.runs = options_.runs;
  plan.seed = options_.seed;
  plan.paired = options_.paired;
  if (!options_.leaves.empty() && !study_.leaves.read(options_.leaves)) return kExitUsage;
  plan.rate = options_.rate.value_or(study_.leaves.rate().value_or(kRate));
  plan.max_ticks = options_.max_ticks.value_or(study_.leaves.ticks().value_or(kMostVirtualTicks));
  read_measures();
  read_shard();
  read_precision();
  read_rows();
  parse_grids();
  plan.arguments = pairs(options_.load.arguments);
  plan.values = pairs(options_.load.values);
  Diagnostics unheard;  // the cells will tell
  const auto project = load_project(options_.tree, first_arguments(), unheard);
  if (project != nullptr) read_grid(project->arguments);
  if (diagnostics_.has_errors()) return kExitUsage;
  int code = kExitSuccess;
  study_.cells.reserve(cell_count(plan));  // their leaves refer to the trees
  for (std::uint64_t cell = 0; cell < cell_count(plan); ++cell) {
    const int it = load_cell(cell);
    if (code == kExitSuccess) code = it;
    if (it == kExitPluginRefused) return it;
  }
  if (!study_.leaves.empty()) plan.files.emplace_back(options_.leaves, study_.leaves.text());
  for (StudyColumn& column : plan.columns) {
    if (column.cells.size() == cell_count(plan)) column.cells.clear();  // all
  }
  for (const auto& plugin : study_.plugins->list()) {
    plan.plugins.emplace_back(plugin.name, plugin.version);
  }
  if (code != kExitSuccess) return code;
  if (diagnostics_.has_errors()) return kExitUsage;
  if (plan.columns.empty()) {
    error("there is nothing to measure: the tree has no parallel",
          "give --measure duration, or predictability:NODE@P");
    return kExitUsage;
  }
  return kExitSuccess;
}

}  // namespace

int load_study(const StudyOptions& options, LoadedStudy& study, Diagnostics& diagnostics) {
  return StudyLoader(options, study, diagnostics).load();
}

}  // namespace lockstep::host
