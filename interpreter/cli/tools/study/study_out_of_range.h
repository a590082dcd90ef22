// Leaves whose progress was out of range in some runs of a study: which, and in how many runs.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cli/tools/study/study_loading.h"
#include "study/workers.h"

namespace lockstep::host {

class StudyOutOfRangeCount {
 public:
  explicit StudyOutOfRangeCount(const LoadedStudy& study) : study_(study) {}

  void add(const StudyOutOfRange& found);
  // A warning for each leaf.
  void add_to(Diagnostics& diagnostics) const;

 private:
  struct Leaf {
    StudyOutOfRange first;
    std::uint64_t runs = 0;
  };
  const LoadedStudy& study_;
  std::map<std::string, Leaf> leaves_;  // by path
};

}  // namespace lockstep::host
