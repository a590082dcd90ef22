// The directory of a study: first study.json, then the results run by
// run, finally summary.csv. After
// a kill at any moment, the study can continue. Only one process at a time writes to it, and never
// through a symbolic link.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"
#include "study/plan.h"
#include "study/result_file.h"
#include "study/row_sequence.h"
#include "study/table.h"

namespace lockstep::host {

class StudyFolder {
 public:
  explicit StudyFolder(std::string path) : path_(std::move(path)) {}

  // Makes the directory or, with `resume`, continues in one with this plan, which must outlive what
  // this returns: the rows that are there. Then the directory is locked.
  Result<RowSequence> begin(const StudyPlan& plan, bool resume);
  Result<void> append(std::string_view lines, std::span<const RowResult> rows);
  Result<void> append(const CellTotals& cell) { return results_->add(cell); }
  // Writes what append() has kept back.
  Result<void> save();
  // Writes the summary, once all rows are there, and returns it.
  Result<std::vector<SummaryRow>> finish(const StudyPlan& plan);
  // Removes what begin() has created and append() has added.
  void discard(const StudyPlan& plan);

  // The plan of a study that is there.
  Result<StudyPlan> read_plan() const;

  std::string file(std::string_view name) const;

 private:
  bool is_there() const;
  Result<void> check_free(const StudyPlan& plan) const;
  Result<void> check_same(const StudyPlan& plan) const;
  Result<void> lock(const StudyPlan& plan);
  Result<RowSequence> make(const StudyPlan& plan);

  std::string path_;
  bool made_directory_ = false;
  FileDescriptor file_;  // of the results; it carries the lock
  std::unique_ptr<ResultFile> results_;
};

}  // namespace lockstep::host
