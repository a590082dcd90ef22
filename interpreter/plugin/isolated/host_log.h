// Carries the log lines of a leafhost's leaves to the host, from any thread: through the ring, with
// a ring of the bell when the host would not look by itself.
#pragma once

#include <cstdint>
#include <string_view>
#include <thread>

#include "plugin/isolated/log_ring.h"

namespace lockstep {

class HostLog {
 public:
  // The thread that makes it is the one that answers calls: the host looks after each of these.
  HostLog(LogRing& ring, int bell) : ring_(ring), bell_(bell) {}
  void write(std::uint32_t caller, lockstep_log_level level, std::string_view text);

 private:
  LogRingWriter ring_;
  int bell_;
  std::thread::id server_ = std::this_thread::get_id();
};

}  // namespace lockstep
