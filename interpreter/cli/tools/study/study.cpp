#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/terminal/outlet.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/tree_argument.h"
#include "cli/outputs.h"
#include "cli/tools/study/study_compare.h"
#include "cli/tools/study/study_fault.h"
#include "cli/tools/study/study_loading.h"
#include "cli/tools/study/study_out_of_range.h"
#include "cli/tools/study/study_progress.h"
#include "cli/tools/study/study_summary.h"
#include "judge/measure/measure_spec.h"
#include "run/stop_signals.h"
#include "study/folder.h"
#include "study/merge.h"
#include "study/plan_check.h"
#include "study/plots/box_plot.h"
#include "study/workers.h"

namespace lockstep::host {
namespace {

struct StudyCommandOptions {
  StudyOptions study;
  unsigned jobs = 0;  // 0: all cores
  std::string out;
  bool resume = false;
  bool json = false;
  bool no_plots = false;
  std::vector<std::string> parts;  // of `merge`
};

int fail(std::string_view message, int code = kExitUsage) {
  print_error(message);
  return code;
}

int print_summary(const StudyCommandOptions& options, const StudyPlan& plan,
                  const std::vector<SummaryRow>& rows) {
  const int written = write_results(options.json ? summary_json(plan, rows) + "\n"
                                                 : summary_table(plan, rows, results_width()));
  Diagnostics notes;
  for (std::string& warning : summary_warnings(plan, rows)) {
    notes.warning("doubtful-result"_code, {}, std::move(warning));
  }
  print_diagnostics(notes, Severity::Warning);
  return written;
}

// Box plots, beside the data. Without gnuplot there are the data.
int draw_plots(const StudyCommandOptions& options, const std::string& directory,
               const StudyPlan& plan, const std::vector<SummaryRow>& rows) {
  if (options.no_plots || plan.shard != StudyShard{}) return kExitSuccess;
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return fail(fmt::format("cannot make '{}': {}", directory, error.message()));
  for (const BoxPlot& plot : box_plots(plan.grid, rows)) {
    const PlotResult drawn = draw(plot, directory);
    if (drawn.ok()) continue;
    print_error(drawn.error);
    if (const int signal = StopSignals::received(); signal != 0) return kExitSignal + signal;
    return drawn.gnuplot_missing ? kExitSuccess : kExitUsage;
  }
  return kExitSuccess;
}

int finish(const StudyCommandOptions& options, const StudyFolder& folder, const StudyPlan& plan,
           const std::vector<SummaryRow>& rows) {
  const int printed = print_summary(options, plan, rows);
  const int drawn = draw_plots(options, folder.file("plots"), plan, rows);
  return first_failure(printed, drawn);
}

std::string out_directory(const StudyCommandOptions& options) {
  if (!options.out.empty()) return options.out;
  return "study-" + std::filesystem::path(options.study.tree).stem().string();
}

// True, after saying so, when a file that the study writes is one that it reads.
bool would_overwrite_input(const std::string& directory, const LoadedStudy& study) {
  std::vector<std::string> documents;
  for (const auto& [path, text] : study.plan.files) documents.push_back(path);
  const auto inputs = inputs_of(documents, *study.plugins);
  std::vector<std::string> outputs;
  for (const char* name : {"study.json", "study.json.new", "runs.csv", "runs.csv.zst",
                           "cells.jsonl", "cell.json", "summary.csv"}) {
    outputs.push_back(directory + '/' + name);
  }
  std::error_code none;
  for (const auto& plot : std::filesystem::directory_iterator(directory + "/plots", none)) {
    outputs.push_back(plot.path().string());
  }
  return std::ranges::any_of(outputs, [&inputs](const std::string& output) {
    return would_overwrite("--out", output, inputs);
  });
}

// Until all rows are there, a leaf has a fault, a row cannot be written or a signal comes.
Result<std::optional<StudyFault>> make_rows(const StudyCommandOptions& options,
                                            const LoadedStudy& study, StudyFolder& folder,
                                            RowSequence& rows, StudyOutOfRangeCount& out_of_range) {
  StudyProgress progress(rows);
  std::optional<StudyFault> fault;
  Result<void> written;
  while (rows.next() && !fault && written && StopSignals::received() == 0) {
    fault = do_work({.plan = study.plan,
                     .cells = study.cells,
                     .measures = study.measures,
                     .first_row = rows.first(),
                     .last_row = rows.last(),
                     .jobs = options.jobs,
                     .hang_limit = from_seconds(options.study.load.plugins.hang_limit),
                     .stop_signal = StopSignals::received,
                     .write =
                         [&](std::string_view lines, std::span<const RowResult> made) {
                           for (const RowResult& row : made) rows.add(row);
                           written = folder.append(lines, made);
                           return written.has_value();
                         },
                     .out_of_range = [&](const StudyOutOfRange& it) { out_of_range.add(it); },
                     .idle = [&] { progress.show(); }});
  }
  // Also what was made before a fault or a signal.
  return written.and_then([&] { return folder.save(); }).map([&] { return fault; });
}

int make_study(const StudyCommandOptions& options, const LoadedStudy& study) {
  const StudyPlan& plan = study.plan;
  StudyFolder folder(out_directory(options));
  auto made = folder.begin(plan, options.resume);
  if (!made) return fail(made.error().message);
  StopSignals::install();
  const Outlet::Thread messages_thread(messages());
  StudyOutOfRangeCount out_of_range(study);
  const auto fault = make_rows(options, study, folder, *made, out_of_range);
  Diagnostics warnings;
  out_of_range.add_to(warnings);
  print_diagnostics(warnings, Severity::Warning);
  if (!fault) return fail(fault.error().message);
  if (const auto& of_leaf = *fault) {
    print_error(fault_text(*of_leaf, study),
                "to repeat it: " + run_command(options.study, study.plan, *of_leaf));
    return kExitLeafFault;
  }
  if (const int signal = StopSignals::received(); signal != 0) {
    return fail("interrupted; continue with the same command and --resume", kExitSignal + signal);
  }
  const auto rows = folder.finish(plan);
  return rows ? finish(options, folder, plan, *rows) : fail(rows.error().message);
}

int run(const StudyCommandOptions& options) {
  keep_stdout_for_results();
  LoadedStudy study;
  Diagnostics diagnostics;
  const int code = load_study(options.study, study, diagnostics);
  print_diagnostics(diagnostics, Severity::Warning);
  if (code != kExitSuccess) return code;
  if (would_overwrite_input(out_directory(options), study)) return kExitUsage;
  Diagnostics refused;
  if (study.leaves.empty() && !study.plugins->initialize(refused)) {
    print_diagnostics(refused, Severity::Warning);
    return kExitPluginRefused;
  }
  return make_study(options, study);
}

int merge(const StudyCommandOptions& options) {
  StopSignals::install();
  const Outlet::Thread messages_thread(messages());
  const auto merged = merge_studies(options.parts, options.out, StopSignals::received);
  if (merged) return finish(options, StudyFolder(options.out), merged->plan, merged->rows);
  const int signal = StopSignals::received();
  return fail(merged.error().message, signal == 0 ? kExitUsage : kExitSignal + signal);
}

void define_merge(CLI::App& app, const std::shared_ptr<StudyCommandOptions>& options) {
  app.add_option("parts", options->parts, "The directories of all parts")
      ->type_name("DIR")
      ->required();
  app.add_option("--out", options->out, "Directory to write, new")->type_name("DIR")->required();
  app.add_flag("--json", options->json, "Print the summary as JSON");
  app.add_flag("--no-plots", options->no_plots, "Draw no box plots");
}

void define_runs(CLI::App& app, StudyOptions& options) {
  app.add_option("-n,--runs", options.runs, "The number of runs for each cell of the grid")
      ->type_name("N")
      ->transform(whole_number(1));
  app.add_option("--until-ci", options.until_ci,
                 "Run a cell only until the 95 % interval of each measure is this narrow: to "
                 "either end 5% of the median, or 0.5 in the unit of the measure; at least 100 "
                 "runs, at most --runs")
      ->type_name("WIDTH");
  app.add_option("--seed", options.seed, "The seeds of all runs are derived from this one")
      ->type_name("S")
      ->transform(whole_number())
      ->capture_default_str();
  app.add_flag("--paired", options.paired,
               "Give run R the same seed in all cells, so that chance affects the cells alike");
  app.add_option("--grid", options.grid,
                 "An <arg> of the tree, or seed, or rate, and its values; or a range, "
                 "NAME=FIRST:LAST:STEP; or names whose values belong together, "
                 "A,B=A1:B1,A2:B2; may be repeated: a cell for each combination")
      ->type_name("NAME=V1,V2,...")
      ->allow_extra_args(false);
  app.add_option("--measure", options.measures,
                 measure_usages() + "; may be repeated. Default: progress-distance")
      ->type_name("MEASURE")
      ->allow_extra_args(false);
  app.add_option("--rate", options.rate,
                 "Ticks per second of the virtual clock (default: that of --leaves, otherwise 100)")
      ->type_name("HZ")
      ->check(number_between(kLeastRate, kMostRate));
  app.add_option("--max-ticks", options.max_ticks,
                 fmt::format("End a run after this many ticks, with the result 'limit' (default: "
                             "the length of the script of --leaves, otherwise {})",
                             kMostVirtualTicks))
      ->type_name("N")
      ->transform(whole_number(1));
  app.add_option(
         "--rows", options.rows,
         "The rows to keep: one for each run in runs.csv or runs.csv.zst, or none. With none a "
         "cell has counts, means and quartiles to 0.05 %, and memory does not grow with the runs")
      ->check(one_of({"csv", "zst", "none"}))
      ->capture_default_str();
  app.add_option("--shard", options.shard, "Make part I of N only; see `lockstep study merge`")
      ->type_name("I/N");
}

std::function<int()> define_study(CLI::App& app) {
  const auto options = std::make_shared<StudyCommandOptions>();
  add_tree_argument(app, options->study.tree, "Tree file", TreeFile::MayLack);
  add_leaves_option(app, options->study.leaves);
  define_runs(app, options->study);
  options->jobs = std::max(1u, std::thread::hardware_concurrency());
  app.add_option("-j,--jobs", options->jobs, "Threads; the result does not depend on it")
      ->type_name("J")
      ->transform(whole_number(1, 1024))
      ->capture_default_str();
  app.add_option("--out", options->out, "Directory to write (default: study-<tree>)")
      ->type_name("DIR");
  app.add_flag("--resume", options->resume, "Continue the study in the directory, if there is one");
  app.add_flag("--json", options->json, "Print the summary as JSON");
  app.add_flag("--no-plots", options->no_plots, "Draw no box plots");
  add_load_options(app, options->study.load);
  options->study.load.plugins.run_programs = true;
  CLI::App* parts = app.add_subcommand("merge", "Merge the parts of a study");
  define_merge(*parts, options);
  CLI::App* cells = app.add_subcommand("compare", "Compare two cells of a study");
  const auto compare = define_compare(*cells);
  return [options, parts, cells, compare] {
    if (parts->parsed()) return merge(*options);
    if (cells->parsed()) return compare();
    if (options->study.tree.empty()) return fail("study: TREE.xml is required");
    if (options->study.runs == 0) return fail("study: --runs is required");
    return run(*options);
  };
}

}  // namespace

extern const Command kStudyCommand{
    "study", "Run a tree many times, over a grid of arguments, and measure it",
    "Writes runs.csv (a row per run, see --rows), summary.csv (box-plot numbers), study.json (how "
    "it was made)\n"
    "and, with gnuplot, plots/; the summary goes to stdout. See `lockstep docs studies`.\n"
    "Exit code: 0 made, 2 usage or a directory that cannot be used, 3 invalid tree, 4 plugin\n"
    "refused, 5 leaf fault, 6 a plugin crashed or hung, 128 + N signal N, as 130 for SIGINT\n"
    "(finished runs are on disk: --resume).\n"
    "\n"
    "Examples:\n"
    "  lockstep study --example predictability --runs 1000 --grid barriers=0,5,50 \\\n"
    "      --measure progress-distance --measure predictability:task@0.6\n"
    "  lockstep study --example paper/example6 --runs 1000 --grid delta=0:0.1:0.01\n"
    "  lockstep study --example paper/example6 --runs 1000 \\\n"
    "      --grid noise,delta=0.01:0.02,0.02:0.05,0.05:0.1\n"
    "  lockstep study --example paper/example5 --runs 100 --paired \\\n"
    "      --grid barrier_count=5,10\n"
    "  lockstep study --example paper/example5 --runs 100000 --until-ci 2% \\\n"
    "      --grid noise=0,0.05\n"
    "  lockstep study --example paper/example5 --runs 10000000 --rows none\n"
    "  lockstep study --example predictability --runs 1000 --shard 1/4 --out part-1\n"
    "  lockstep study merge part-* --out study\n"
    "  lockstep study compare study-example5 --cells 0 1",
    define_study};

}  // namespace lockstep::host
