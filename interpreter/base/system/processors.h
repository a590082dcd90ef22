// A set of processors, which the operating system counts from 0.
#pragma once

#include <sched.h>

#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

class Processors {
 public:
  // "0-3,6". Nothing: the text is no such list, or is empty.
  static std::optional<Processors> parse(std::string_view text);
  // Where the calling thread may run.
  static Processors allowed();

  // As `parse` reads it; "" if there is none.
  std::string text() const;
  bool has(int processor) const { return CPU_ISSET(processor, &set_) != 0; }
  int count() const { return CPU_COUNT(&set_); }

  // Why the calling thread may not run on one of them; nothing: it may.
  std::optional<Problem> refusal() const;
  // From now on the calling thread, and those that it starts, run on these. After a problem,
  // nothing has changed.
  std::optional<Problem> bind_this_thread() const;

 private:
  cpu_set_t set_{};
};

}  // namespace lockstep::host
