// Carries the log lines of a leafhost's leaves to the host, from any thread, through a ring. Rings
// the bell when the host would not check the ring by itself.
#pragma once

#include <cstdint>
#include <string_view>
#include <thread>

#include "leaves/remote/shared_memory/channel.h"

namespace lockstep::host {

class HostLog {
 public:
  // The thread that constructs it answers the calls: the host checks the ring after each call.
  // `bell` is an eventfd.
  HostLog(Channel& channel, int bell)
      : calls_(channel.call_log()), threads_(channel.thread_log()), bell_(bell) {}
  void write(std::uint32_t caller, lockstep_log_level level, std::string_view text);

 private:
  LogRingWriter calls_, threads_;
  int bell_;
  std::thread::id server_ = std::this_thread::get_id();
};

}  // namespace lockstep::host
