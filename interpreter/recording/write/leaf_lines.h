// Carries the lines that leaves log from any thread to the tick thread, for a recording. A line
// that the file did not accept waits for the next tick. Used by recorder.
#pragma once

#include <atomic>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "recording/recording.h"

namespace lockstep {

class LeafLines {
 public:
  static constexpr std::size_t kRoom = std::size_t{64} << 10u;  // bytes that wait; more is left out

  // From any thread.
  void add(std::string_view who, std::string_view level, std::string_view text);

  // The waiting lines; on the tick thread. Valid until the next call. Takes no lock if there are
  // none.
  std::span<const RecordedLog> lines();
  // Call when the file has accepted the last result of lines().
  void keep();
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::atomic<bool> has_new_{false};
  std::atomic<std::uint64_t> left_out_{0};
  std::mutex mutex_;  // for the next two
  std::vector<RecordedLog> new_;
  std::size_t size_ = 0;              // bytes of all that wait
  std::vector<RecordedLog> waiting_;  // of the tick thread
};

}  // namespace lockstep
