// Carries the log lines of a leafhost's leaves to the host, from any thread: through a ring, and by
// ringing the bell when the host would not look by itself.
#pragma once

#include <cstdint>
#include <string_view>
#include <thread>

#include "plugin/isolated/channel.h"

namespace lockstep {

class HostLog {
 public:
  // The thread that makes it is the one that answers calls: the host looks after each of these.
  // `bell` is an eventfd.
  HostLog(Channel& channel, int bell)
      : calls_(channel.call_log()), threads_(channel.thread_log()), bell_(bell) {}
  void write(std::uint32_t caller, lockstep_log_level level, std::string_view text);

 private:
  LogRingWriter calls_, threads_;
  int bell_;
  std::thread::id server_ = std::this_thread::get_id();
};

}  // namespace lockstep
