// The directory of a study: study.json first, then runs.csv row by row, at last summary.csv. What a
// kill at any moment leaves is a beginning that the study can go on from. One process at a time
// writes to it, and none writes through a symbolic link.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_descriptor.h"
#include "study/plan.h"
#include "study/table.h"

namespace lockstep {

class StudyFolder {
 public:
  explicit StudyFolder(std::string path) : path_(std::move(path)) {}

  // Makes the directory, or takes over what is there when `resume` and it is of this plan. The
  // number of rows that are there already; on failure error() tells. From then on the directory is
  // locked.
  std::optional<std::uint64_t> begin(const StudyPlan& plan, bool resume);
  bool append(std::string_view lines);
  // All rows are there: writes the summary and returns it.
  std::optional<std::vector<SummaryRow>> finish(const StudyPlan& plan);
  // Removes what begin() has made where nothing was, and append() has added.
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
  std::optional<std::uint64_t> take_over(const StudyPlan& plan);
  bool write_whole(const std::string& name, std::string_view text);

  std::string path_;
  bool made_directory_ = false;
  FileDescriptor runs_;  // runs.csv; it carries the lock
  std::string error_;
};

}  // namespace lockstep
