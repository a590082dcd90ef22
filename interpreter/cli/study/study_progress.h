// How far a study is, on stderr: a bar on a terminal, else a line now and then.
#pragma once

#include <cstdint>

#include "core/clock.h"

namespace lockstep {

class StudyProgress {
 public:
  // Of `total` runs, `done` were there before.
  StudyProgress(std::uint64_t done, std::uint64_t total);
  // Removes the bar.
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;

  void add(std::uint64_t runs) { done_ += runs; }
  // Prints when it is time to.
  void show();

 private:
  const bool is_terminal_;
  const std::uint64_t before_;
  const std::uint64_t total_;
  std::uint64_t done_;
  const Nanoseconds start_ = monotonic_now();
  Nanoseconds shown_;
  bool is_visible_ = false;
};

}  // namespace lockstep
