// The directory of a study: first study.json, then runs.csv row by row, finally summary.csv. After
// a kill at any moment, the study can continue. Only one process at a time writes to it, and never
// through a symbolic link.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_descriptor.h"
#include "study/plan.h"
#include "study/row_sequence.h"
#include "study/table.h"

namespace lockstep {

class StudyFolder {
 public:
  explicit StudyFolder(std::string path) : path_(std::move(path)) {}

  // Makes the directory or, with `resume`, continues in one with this plan, which must outlive what
  // this returns: the rows that are there. On failure error() has the reason. Then the directory is
  // locked.
  std::optional<RowSequence> begin(const StudyPlan& plan, bool resume);
  bool append(std::string_view lines);
  // Writes the summary, once all rows are there, and returns it.
  std::optional<std::vector<SummaryRow>> finish(const StudyPlan& plan);
  // Removes what begin() has created and append() has added.
  void discard();

  // The plan of a study that is there.
  std::optional<StudyPlan> read_plan();

  std::string file(std::string_view name) const;
  const std::string& error() const { return error_; }

 private:
  bool fail(std::string what);
  bool fail_to_write(std::string_view name, int reason);
  bool is_there() const;
  bool is_free();
  bool lock();
  bool make(const StudyPlan& plan);
  std::optional<RowSequence> take_over(const StudyPlan& plan);
  bool write_whole(const std::string& name, std::string_view text);

  std::string path_;
  bool made_directory_ = false;
  FileDescriptor runs_;  // runs.csv; it carries the lock
  std::string error_;
};

}  // namespace lockstep
