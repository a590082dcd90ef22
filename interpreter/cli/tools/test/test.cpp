#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "base/system/freed_memory.h"
#include "base/system/output_file.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/outputs.h"
#include "cli/tools/test/file_watch.h"
#include "cli/tools/test/test_options.h"
#include "leaves/models.h"
#include "run/stop_signals.h"
#include "scenario/discover.h"
#include "scenario/mutation_run.h"
#include "scenario/report_text.h"
#include "scenario/scenario_reader.h"
#include "scenario/test_run.h"

namespace lockstep::host {
namespace {

// The value of --filter: a name, or a part of names; with * a pattern for whole names.
struct Filter {
  std::string text;
  bool is_whole_name = false;  // of a scenario: then no other is meant

  bool fits(const std::string& name) const {
    if (is_whole_name) return name == text;
    if (text.find('*') != std::string::npos) return matches(text, name);
    return name.find(text) != std::string::npos;
  }
};

class TestCommand {
 public:
  explicit TestCommand(const TestCommandOptions& options) : options_(options) {}

  int run() {
    if (!read_files()) return kExitUsage;
    read_filters();
    if (options_.list) return list();
    const Nanoseconds began = monotonic_now();
    StopSignals::install();
    keep_freed_memory();
    TestRun tests(
        files(), [&](const auto&, const Scenario& it) { return is_chosen(it); }, test_options());
    if (tests.count() == 0) return tell_none();
    print_diagnostics(tests.diagnostics(), Severity::Warning);
    if (would_overwrite_input(tests)) return kExitUsage;
    tests.run([&](const ScenarioReport& report) { add(report); });
    counts_.took = monotonic_now() - began;
    const int code = finish();
    return options_.mutates ? first_failure(code, mutate()) : code;
  }

 private:
  bool is_chosen(const Scenario& scenario) const {
    return filters_.empty() ||
           std::ranges::any_of(filters_, [&](const Filter& it) { return it.fits(scenario.name); });
  }

  void read_filters() {
    for (const std::string& text : options_.filters) {
      Filter& filter = filters_.emplace_back(Filter{text});
      for (const auto& file : files_) {
        filter.is_whole_name |=
            std::ranges::find(file->scenarios, text, &Scenario::name) != file->scenarios.end();
      }
    }
  }

  std::vector<const ScenarioFile*> files() const {
    std::vector<const ScenarioFile*> files;
    for (const auto& it : files_) files.push_back(it.get());
    return files;
  }

  // False: a path is not there, which is reported.
  bool read_files() {
    auto found = find_scenario_files(options_.paths);
    if (!found) {
      print_error(found.error().message, found.error().hint);
      return false;
    }
    for (const std::string& path : *found) {
      Diagnostics diagnostics;
      auto file = read_scenarios(path, diagnostics);
      print_diagnostics(diagnostics, Severity::Warning);
      if (diagnostics.has_errors() || file == nullptr) {
        code_ = first_failure(code_, kExitInvalidTree);
        add_unreadable(path, diagnostics);
      } else {
        files_.push_back(std::move(file));
      }
    }
    return true;
  }

  bool would_overwrite_input(const TestRun& tests) const {
    std::vector<NamedFile> used = inputs_of(tests.documents(), tests.plugins());
    for (const auto& file : files_) {
      used.push_back(named_file(file->path));
      for (const Scenario& scenario : file->scenarios) {
        for (const BindingRow& it : scenario.bindings)
          if (!it.recording.empty()) used.push_back(named_file(it.recording));
        for (const Expectation& it : scenario.expectations) {
          if (it.kind == Expectation::Kind::SameAs) used.push_back(named_file(it.texts[0]));
        }
      }
    }
    const std::pair<std::string_view, const std::string&> outputs[] = {
        {"--junit", options_.junit},
        {"--coverage-html", options_.coverage.page},
        {"--lcov", options_.coverage.lcov}};
    for (const std::string& it : options_.plugins.plugins) used.push_back(named_file(it));
    std::map<std::filesystem::path, std::string_view> written;
    return std::ranges::any_of(outputs, [&](const auto& it) {
      if (it.second.empty()) return false;
      const auto path = std::filesystem::path(it.second).lexically_normal();
      if (std::error_code none; std::filesystem::is_character_file(path, none)) return false;
      const auto [other, is_new] = written.emplace(path, it.first);
      if (is_new) return would_overwrite(it.first, it.second, used);
      print_error(fmt::format("{} and {} name the same file", other->second, it.first),
                  "name another file");
      return true;
    });
  }

  // For programs that read the results: a file counts as one scenario.
  void add_unreadable(const std::string& path, const Diagnostics& diagnostics) {
    ++counts_.invalid;
    ReportedScenario it{
        .file = path, .name = "the file", .place = path, .outcome = ScenarioOutcome::Invalid};
    for (const Diagnostic& error : diagnostics.all()) {
      if (error.severity != Severity::Error) continue;
      it.failures.push_back({to_text(error.location), error.message, {}});
    }
    reported_.push_back(std::move(it));
  }

  TestOptions test_options() const {
    TestOptions options{.jobs = options_.jobs,
                        .hang_limit = from_seconds(options_.plugins.hang_limit),
                        .out = options_.out,
                        .covers = options_.coverage.is_wanted(),
                        .updates = options_.updates,
                        .stop_signal = StopSignals::received};
    options.load.plugins = options_.plugins;
    return options;
  }

  int list() const {
    std::string text;
    for (const auto& file : files_) {
      for (const Scenario& it : file->scenarios) {
        if (!is_chosen(it)) continue;
        text +=
            fmt::format("{}: {}\n", to_text(file->sources.locate(it.place)), printable(it.name));
      }
    }
    return first_failure(write_results(text), code_);
  }

  int tell_none() const {
    if (code_ != kExitSuccess) return code_;
    std::vector<std::string_view> names;
    for (const auto& file : files_) {
      for (const Scenario& it : file->scenarios) names.emplace_back(it.name);
    }
    if (names.empty()) {
      print_error("there are no scenarios",
                  "write NAME.test.xml next to a tree; `lockstep docs testing` has an example");
    } else {
      print_error("no scenario is chosen by --filter",
                  options_.filters.size() == 1 ? suggest(options_.filters[0], names, "there are")
                                               : std::string());
    }
    return kExitUsage;
  }

  void add(const ScenarioReport& report) {
    counts_.add(report);
    if (!report.errors.empty()) {
      const bool is_refused = report.failure == LoadFailure::PluginRefused;
      invalid_ = first_failure(invalid_, is_refused ? kExitPluginRefused : kExitInvalidTree);
    }
    updated_ += report.written;
    if (report.coverage != nullptr) coverage_.add(report);
    if (options_.json || !options_.junit.empty()) reported_.push_back(reported(report));
    if (options_.json) return;
    std::string text;
    if (report.file != shown_) {
      shown_ = report.file;
      text = printable(report.file->path) + '\n';
      width_ = 0;
      for (const Scenario& it : report.file->scenarios) {
        if (is_chosen(it)) width_ = std::max(width_, it.name.size());
      }
      width_ = std::min<std::size_t>(width_, 50);
    }
    write(text + to_text(report, width_, wants_color(results_file()), told_));
    told_ = report.errors;
  }

  // A stdout that takes no more is reported once.
  void write(const std::string& text) {
    if (written_ == kExitSuccess) written_ = write_results(text);
  }

  int finish() {
    int covered = kExitSuccess;
    if (options_.coverage.is_wanted()) {
      const bool is_quiet = options_.json || written_ != kExitSuccess;
      covered = write_coverage(options_.coverage, coverage_, options_.jobs, is_quiet);
    }
    std::string text = options_.json ? to_json(reported_, counts_) : to_text(counts_);
    if (updated_ > 0 && !options_.json) {
      text += fmt::format("{} written\n", counted(updated_, "recording"));
    }
    write(text);
    if (!options_.junit.empty() && !write_junit()) return kExitUsage;
    if (const int signal = StopSignals::received(); signal != 0) return kExitSignal + signal;
    if (counts_.failed > 0) return first_failure(written_, kExitFailure);
    return first_failure(written_, first_failure(invalid_, first_failure(code_, covered)));
  }

  // Only where all is as expected without a change.
  int mutate() const {
    if (counts_.failed > 0 || counts_.invalid > 0 || StopSignals::received() != 0) {
      print_error("--mutate: the scenarios must pass first");
      return kExitFailure;
    }
    const auto trees = run_mutations(
        files(), [&](const auto&, const Scenario& it) { return is_chosen(it); }, test_options());
    const int written = options_.json ? kExitSuccess : write_results(to_text(trees));
    const auto& least = options_.coverage.least;
    if (!least || percent(trees) >= *least) return written;
    print_error(
        fmt::format("{:.1f} % of the changes are noticed, less than {} %", percent(trees), *least));
    return kExitFailure;
  }

  bool write_junit() const {
    const auto done = write_output(options_.junit, to_junit(reported_, counts_));
    if (!done) print_error("--junit: " + printable(done.error().message));
    return done.has_value();
  }

  const TestCommandOptions& options_;
  std::vector<std::unique_ptr<ScenarioFile>> files_;
  std::vector<Filter> filters_;
  std::vector<ReportedScenario> reported_;
  TestCounts counts_;
  const ScenarioFile* shown_ = nullptr;  // whose name is printed
  std::size_t width_ = 0;
  std::vector<Diagnostic> told_;  // of the last scenario
  Coverage coverage_;
  std::uint64_t updated_ = 0;  // recordings
  int code_ = kExitSuccess, invalid_ = kExitSuccess, written_ = kExitSuccess;
};

int test(const TestCommandOptions& options) {
  keep_stdout_for_results();
  if (!options.watches) return TestCommand(options).run();
  StopSignals::install();
  FileWatch watch(options.paths);
  while (true) {
    watch.begin();
    TestCommand(options).run();
    if (!watch.wait()) return kExitSignal + StopSignals::received();
  }
}

std::function<int()> define_test(CLI::App& app) {
  const auto options = std::make_shared<TestCommandOptions>();
  define_test_options(app, *options);
  return [options] { return test(*options); };
}

}  // namespace

extern const Command kTestCommand{
    "test", "Play scenarios: test trees without a robot",
    "stdout gets one line for each scenario, and for each failure what was expected, the result,\n"
    "the place and a recording. Messages about files go to stderr.\n"
    "Exit code: 0 all scenarios passed, 1 a scenario failed, or --fail-under, 2 usage, or there "
    "are no scenarios,\n"
    "3 invalid scenarios or trees, 4 plugin refused, 128 + N signal N.\n"
    "\n"
    "Examples:\n"
    "  lockstep test\n"
    "  lockstep test trees --junit results.xml\n"
    "  lockstep test trees --coverage --fail-under 90\n"
    "  lockstep test tree.test.xml --filter 'the arm slips'",
    define_test};

}  // namespace lockstep::host
