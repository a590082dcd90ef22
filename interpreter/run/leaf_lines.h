// Carries the lines that leaves log from any thread to the tick thread. A line that is not accepted
// there, as by a full disk, waits for the next tick. Used by recorder and snapshot_feed.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/mutex.h"

namespace lockstep::host {

struct LeafLine {
  std::string who, level, text;  // the path of a leaf, or the name of a plugin; "info"; the line

  friend bool operator==(const LeafLine&, const LeafLine&) = default;
};

class LeafLines {
 public:
  static constexpr std::size_t kRoom = std::size_t{64} << 10u;  // bytes that wait; more is left out

  // From any thread.
  void add(std::string_view who, std::string_view level, std::string_view text);

  // The waiting lines; on the tick thread. Valid until the next call. Takes no lock if there are
  // none.
  std::span<const LeafLine> lines();
  // Call when the last result of lines() was accepted.
  void keep();
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::atomic<bool> has_new_{false};
  std::atomic<std::uint64_t> left_out_{0};
  Mutex mutex_;
  std::vector<LeafLine> new_ LOCKSTEP_GUARDED_BY(mutex_);
  std::size_t size_ LOCKSTEP_GUARDED_BY(mutex_) = 0;  // bytes of all that wait
  std::vector<LeafLine> waiting_;                     // of the tick thread
};

// The last lines of a run.
struct RecentLines {
  static constexpr std::size_t kMost = 16;

  std::vector<LeafLine> lines = {};
  std::uint64_t earlier = 0;  // that came before these, or were left out

  void add(const LeafLine& line);
  std::uint64_t count() const { return earlier + lines.size(); }
  friend bool operator==(const RecentLines&, const RecentLines&) = default;
};

}  // namespace lockstep::host
