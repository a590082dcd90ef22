// The command line of a study -> its plan and the tree of each cell. Errors in any cell are
// reported before the first run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/load/given_leaves.h"
#include "run/loop.h"
#include "study/study_run.h"

namespace lockstep::host {

struct StudyOptions {
  LoadCommandOptions load;
  std::string tree;
  std::string leaves;  // what they do in place of plugins; "": plugins are asked
  std::uint64_t runs = 0;
  std::uint64_t seed = 0;
  bool paired = false;
  std::optional<std::string> until_ci = {};  // as precision_from() reads it
  std::vector<std::string> grid;             // as parse_grid() reads it
  std::vector<std::string> measures;         // none: progress-distance
  std::string rows = "csv";                  // a word of kStudyRows
  std::string shard;                         // I/N
  std::optional<double> rate;                // none: that of the leaves, else 100
  std::optional<std::uint64_t> max_ticks;    // none: that of the leaves, else kMostVirtualTicks
};

struct LoadedStudy {
  GivenLeaves leaves;  // to which the trees refer
  StudyPlan plan;
  std::vector<MeasureSpec> measures;
  std::vector<StudyCell> cells;
  std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>();
};

// Does all that can be done. Returns the exit code; 0 when the study can be made.
int load_study(const StudyOptions& options, LoadedStudy& study, Diagnostics& diagnostics);

}  // namespace lockstep::host
