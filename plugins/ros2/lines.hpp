// Lines for the log of a leaf: one thread writes them, another reads them without waiting.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

namespace ros2 {

class Lines {
 public:
  void add(std::string line) {
    constexpr std::size_t kMost = 100;
    const std::lock_guard lock(mutex_);
    if (lines_.size() < kMost) lines_.push_back(std::move(line));
    has_some_ = true;
  }
  bool next(std::string& line) {
    if (!has_some_.load(std::memory_order_relaxed)) return false;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    if (lines_.empty()) {
      has_some_ = false;
      return false;
    }
    line = std::move(lines_.front());
    lines_.erase(lines_.begin());
    return true;
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> has_some_{false};
  std::vector<std::string> lines_;
};

}  // namespace ros2
