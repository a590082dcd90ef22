// Scenarios of many files, played on several threads: each tree is loaded once. Reports come in the
// order of the files, whatever the number of threads.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "leaves/leaf_file.h"
#include "scenario/fixture.h"
#include "scenario/node_coverage.h"
#include "scenario/scenario_runner.h"

namespace lockstep::host {

struct ScenarioReport {
  const ScenarioFile* file = nullptr;
  const Scenario* scenario = nullptr;
  std::vector<Diagnostic> errors = {};         // it could not be played
  LoadFailure failure = LoadFailure::Invalid;  // of its tree, if that is why
  std::vector<Surprise> surprises = {};        // of the first run that has one
  std::uint64_t seed = 0;                      // of that run
  std::uint64_t runs = 0, ticks = 0;           // of all runs
  std::string recording = {};                  // of that run; "": there is none
  bool was_stopped = false;                    // by a signal
  std::uint64_t written = 0;                   // recordings, by --update
  // The coverage is of all runs; null: nobody asks for it, or it has none.
  std::shared_ptr<const Fixture> fixture = {};
  std::shared_ptr<const NodeCoverage> coverage = {};
  const LeafFile* leaves = nullptr;
  double rate = 0;

  bool is_good() const { return errors.empty() && surprises.empty() && !was_stopped; }
};

struct TestOptions {
  LoadOptions load = {};
  unsigned jobs = 1;
  Nanoseconds hang_limit{0};
  std::string out = {};  // where recordings of failures are written; "": nowhere
  // With another text in place of this file; names that are gone then are left out.
  std::string changed_tree = {}, changed_text = {};
  bool covers = false;
  bool updates = false;  // writes the recordings that runs are compared with
  std::function<int()> stop_signal = {};
};

class TestRun {
 public:
  // Loads the trees of these scenarios; `files` must outlive this.
  TestRun(const std::vector<const ScenarioFile*>& files,
          const std::function<bool(const ScenarioFile&, const Scenario&)>& is_chosen,
          TestOptions options);

  std::size_t count() const { return parts_.size(); }
  // The files of trees and leaves that were read for them.
  std::vector<std::string> documents() const;
  const PluginSet& plugins() const { return *plugins_; }
  // Warnings about the trees.
  Diagnostics& diagnostics() { return diagnostics_; }
  // On the caller's thread, in order; a report is not kept.
  void run(const std::function<void(const ScenarioReport&)>& report);

 private:
  struct Part {
    const ScenarioFile* file;
    const Scenario* scenario;
    std::shared_ptr<const Fixture> fixture = {};  // null: it cannot be loaded
    const LeafFile* leaves = nullptr;             // null: there is none
    std::vector<Diagnostic> errors = {};
    LoadFailure failure = LoadFailure::Invalid;
    std::string stem = {};  // of the names of its files
  };

  struct LoadedFixture {
    std::shared_ptr<const Fixture> fixture;
    std::vector<Diagnostic> errors;
    LoadFailure failure = LoadFailure::Invalid;
  };

  void prepare(Part& part);
  LoadedFixture& fixture(const Fixture::Key& key);
  void load_stage(Part& part);
  void load_leaves(Part& part);

  const TestOptions options_;
  Diagnostics diagnostics_;
  std::shared_ptr<PluginSet> plugins_ = std::make_shared<PluginSet>();
  struct LoadedLeaves {
    std::unique_ptr<LeafFile> file;
    std::vector<Diagnostic> errors;
  };
  std::map<Fixture::Key, LoadedFixture> fixtures_;
  std::map<std::string, LoadedLeaves> leaves_;
  std::vector<Part> parts_;
};

}  // namespace lockstep::host
