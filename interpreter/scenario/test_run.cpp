#include "scenario/test_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <exception>
#include <filesystem>
#include <semaphore>
#include <set>
#include <thread>

#include "leaves/remote/json_lines/orphans.h"
#include "run/plugin_thread.h"
#include "scenario/golden.h"
#include "scenario/worker.h"

namespace lockstep::host {
namespace {

std::vector<Diagnostic> errors_of(Diagnostics& diagnostics) {
  std::vector<Diagnostic> errors;
  diagnostics.sort();
  for (const Diagnostic& it : diagnostics.all()) {
    if (it.severity == Severity::Error) errors.push_back(it);
  }
  return errors;
}

// Letters and digits; the rest is "-".
std::string plain(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_') {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (name.ends_with('-')) name.pop_back();
  constexpr std::size_t kLongestName = 100;
  return name.substr(0, kLongestName);
}

std::string stem_of(const ScenarioFile& file, const Scenario& scenario) {
  std::string stem = std::filesystem::path(file.path).stem().string();
  if (stem.ends_with(".test")) stem.resize(stem.size() - 5);
  return plain(stem) + '.' + plain(scenario.name);
}

}  // namespace

TestRun::TestRun(const std::vector<const ScenarioFile*>& files,
                 const std::function<bool(const ScenarioFile&, const Scenario&)>& is_chosen,
                 TestOptions options)
    : options_(std::move(options)) {
  watch_this_thread(options_.hang_limit);
  for (const ScenarioFile* file : files) {
    for (const Scenario& scenario : file->scenarios) {
      if (is_chosen(*file, scenario)) parts_.push_back({file, &scenario});
    }
  }
  std::map<std::string, int> stems;
  const GoldenFiles goldens(files);
  for (Part& part : parts_) {
    prepare(part);
    if (options_.updates) goldens.check(*part.file, *part.scenario, part.errors);
    part.stem = stem_of(*part.file, *part.scenario);
    if (const int count = ++stems[part.stem]; count > 1) part.stem += fmt::format("-{}", count);
  }
  if (std::ranges::any_of(plugins_->list(), &PluginSet::Info::isolated)) take_over_orphans();
}

void TestRun::prepare(Part& part) {
  load_stage(part);
  if (!part.scenario->leaves.empty()) load_leaves(part);
}

TestRun::LoadedFixture& TestRun::fixture(const Fixture::Key& key) {
  const auto [it, is_new] = fixtures_.try_emplace(key);
  LoadedFixture& loaded = it->second;
  if (is_new) {
    Diagnostics diagnostics;
    const bool is_changed =
        !options_.changed_tree.empty() && it->first.tree == options_.changed_tree;
    loaded.fixture = Fixture::load(it->first, is_changed ? &options_.changed_text : nullptr,
                                   options_.load, diagnostics, plugins_, loaded.failure);
    // Its leaf would succeed, and with it a scenario of a tree that no run can load.
    for (const Diagnostic& about : diagnostics.all()) {
      const bool is_of_tree = about.code.text() == "unknown-tree"_code.text();
      if (is_of_tree && about.severity == Severity::Warning) diagnostics_.add(about);
    }
    if (loaded.fixture == nullptr) {
      loaded.errors = errors_of(diagnostics);
      if (loaded.errors.empty()) loaded.errors.push_back({.message = "the tree cannot be loaded"});
    }
  }
  return loaded;
}

// Values declare entries, as `--set` does; one that comes later is unset before. Most trees need
// none, so that scenarios with different values share a fixture. What leaf models do depends on
// them, and without strict types the type of an entry.
void TestRun::load_stage(Part& part) {
  Fixture::Key key = Fixture::key_of(*part.scenario);
  Fixture::Key with_values = key;
  with_values.values = Fixture::start_values(*part.scenario);
  with_values.later = Fixture::later_values(*part.scenario);
  const bool needs_values = part.scenario->is_verified || !part.scenario->leaves.empty();
  if (needs_values || fixture(key).fixture == nullptr) {
    key = std::move(with_values);
  } else if (!fixture(key).fixture->tree().rules->strict_types &&
             fixture(with_values).fixture != nullptr) {
    key = std::move(with_values);
  }
  const LoadedFixture& loaded = fixture(key);
  part.fixture = loaded.fixture;
  part.errors = loaded.errors;
  part.failure = loaded.failure;
  // An error without a place in the tree is about what the scenario asks of it.
  const Scenario& scenario = *part.scenario;
  for (Diagnostic& error : part.errors) {
    if (!error.location.file.empty()) continue;
    const Place place = scenario.arguments.empty() ? scenario.place : scenario.arguments[0].place;
    error.location = part.file->sources.locate_value(place);
  }
}

void TestRun::load_leaves(Part& part) {
  const std::string& path = part.scenario->leaves;
  const auto [it, is_new] = leaves_.try_emplace(path);
  LoadedLeaves& loaded = it->second;
  if (is_new) {
    Diagnostics diagnostics;
    loaded.file = load_leaf_file(path, diagnostics);
    loaded.errors = errors_of(diagnostics);
  }
  part.leaves = loaded.file.get();
  part.errors.insert(part.errors.end(), loaded.errors.begin(), loaded.errors.end());
}

std::vector<std::string> TestRun::documents() const {
  std::vector<std::string> paths;
  for (const auto& [key, loaded] : fixtures_) {
    paths.push_back(key.tree);
    if (loaded.fixture == nullptr) continue;
    for (const auto& source : loaded.fixture->sources().all()) paths.push_back(source->path());
  }
  for (const auto& [path, loaded] : leaves_) paths.push_back(path);
  return paths;
}

void TestRun::run(const std::function<void(const ScenarioReport&)>& report) {
  std::vector<ScenarioReport> reports(parts_.size());
  std::vector<std::atomic<bool>> ready(parts_.size());
  std::atomic<std::size_t> next{0};
  std::counting_semaphore<> made{0};
  const auto work = [&] {
    watch_this_thread(options_.hang_limit);
    ScenarioWorker worker(options_, *plugins_);
    for (std::size_t i = next++; i < parts_.size(); i = next++) {
      const Part& part = parts_[i];
      reports[i] = worker.play({.file = part.file,
                                .scenario = part.scenario,
                                .fixture = part.fixture,
                                .leaves = part.leaves,
                                .errors = part.errors,
                                .failure = part.failure,
                                .stem = part.stem});
      ready[i] = true;
      made.release();
    }
    leave_thread_to_plugins();
  };
  std::vector<std::jthread> threads;
  const auto jobs = std::min<std::size_t>(options_.jobs, parts_.size());
  for (std::size_t i = 0; i < jobs; ++i) threads.emplace_back(work);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    while (!ready[i]) made.acquire();
    report(reports[i]);
    reports[i] = {};
  }
}

}  // namespace lockstep::host
