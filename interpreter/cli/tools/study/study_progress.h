// How far a study is, on stderr: a bar on a terminal, else a line now and then.
#pragma once

#include <cstdint>

#include "base/core/clock.h"
#include "study/row_sequence.h"

namespace lockstep::host {

class StudyProgress {
 public:
  explicit StudyProgress(const RowSequence& rows);
  // Removes the bar.
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  // Prints when it is time to.
  void show();

 private:
  const bool is_terminal_;
  const RowSequence& rows_;
  const std::uint64_t before_;
  const Nanoseconds start_ = monotonic_now();
  Nanoseconds shown_;
  bool is_visible_ = false;
};

}  // namespace lockstep::host
