// The directory of a study: study.json first, then runs.csv row by row, at last summary.csv. What a
// kill at any moment leaves is a beginning that the study can go on from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/plan.h"
#include "study/table.h"

namespace lockstep {

class StudyFolder {
 public:
  explicit StudyFolder(std::string path) : path_(std::move(path)) {}
  ~StudyFolder();
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  // Makes the directory, or takes over what is there when `resume` and it is of this plan. The
  // number of rows that are there already; on failure error() tells.
  std::optional<std::uint64_t> begin(const StudyPlan& plan, bool resume);
  bool append(std::string_view lines);
  // All rows are there: writes the summary and returns it.
  std::optional<std::vector<SummaryRow>> finish(const StudyPlan& plan);

  // The plan of a study that is there.
  std::optional<StudyPlan> read_plan();

  std::string file(std::string_view name) const;
  const std::string& error() const { return error_; }

 private:
  bool fail(std::string what);
  bool is_free();
  bool write_whole(const std::string& name, std::string_view text);
  bool open_runs(std::uint64_t keep);

  std::string path_;
  int runs_ = -1;
  std::string error_;
};

}  // namespace lockstep
