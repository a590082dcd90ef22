// A command of lockstep in a process of its own, with limits: what a crash, a hang or a hostile
// tree does ends that process, and not the server.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/core/clock.h"
#include "base/system/pipe.h"

namespace lockstep::host {

struct ToolLimits {
  Nanoseconds time;
  std::size_t memory;                           // of address space, in bytes
  std::size_t output = std::size_t{64} << 20u;  // in bytes, of each stream
};

struct ToolOutcome {
  enum class End : unsigned char { Exited, Signal, Time, Output, Cancelled, NotStarted };
  End end = End::NotStarted;
  int code = 0;  // the exit code, the signal, or the errno
  std::string out, err;
};

class ToolProcess {
 public:
  ToolProcess();
  ToolProcess(const ToolProcess&) = delete;
  ToolProcess& operator=(const ToolProcess&) = delete;

  // Starts this program with these words and waits for its end. `progress` is called each second
  // with the last line of stderr.
  ToolOutcome run(const std::vector<std::string>& words, const std::string& input,
                  const ToolLimits& limits,
                  const std::function<void(double seconds, std::string_view line)>& progress);
  // From another thread: run() returns soon.
  void cancel();

 private:
  Pipe cancel_;
};

}  // namespace lockstep::host
