// How much of a recording has been read: a line on a terminal, once it takes long.
#pragma once

#include <cstdint>
#include <string>

#include "base/core/clock.h"

namespace lockstep::host {

class ReadingProgress {
 public:
  // Begins a line for this file; "-" is stdin.
  explicit ReadingProgress(const std::string& path);
  // Removes the line.
  ~ReadingProgress();
  ReadingProgress(const ReadingProgress&) = delete;
  ReadingProgress& operator=(const ReadingProgress&) = delete;

  // So many bytes more. Prints when it is time to.
  void add(std::uint64_t bytes);

 private:
  std::string text() const;

  const bool is_terminal_;
  std::uint64_t all_ = 0;  // 0: not known, as of a pipe
  std::uint64_t read_ = 0;
  Nanoseconds next_;
  bool is_visible_ = false;
};

}  // namespace lockstep::host
