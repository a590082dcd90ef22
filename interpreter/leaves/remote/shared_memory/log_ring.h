// A queue of the lines that the leaves of a leafhost log: bytes in shared memory, written by any
// thread of one process and read by any thread of the other. Lines that do not fit are counted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "base/system/mutex.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// As it lies in shared memory; all zero is empty.
struct LogRing {
  static constexpr std::size_t kSize = std::size_t{1} << 18;
  std::atomic<std::uint64_t> written;  // bytes, ever
  std::atomic<std::uint64_t> read;
  std::atomic<std::uint32_t> lost;  // lines
  std::array<std::byte, kSize> bytes;
};

class LogRingWriter {
 public:
  explicit LogRingWriter(LogRing& ring) : ring_(ring) {}
  // True when the ring fills up, so that the reader should be called. Text is cut at 32 KiB.
  bool append(std::uint32_t caller, lockstep_log_level level, std::string_view text);

 private:
  Mutex mutex_;  // of who writes
  LogRing& ring_;
};

// Not thread-safe: its owner allows one thread at a time. Checks everything that it reads.
class LogRingReader {
 public:
  explicit LogRingReader(LogRing& ring) : ring_(ring) {}
  using Line = std::function<void(std::uint32_t caller, lockstep_log_level, const char* text)>;
  // Reads at least one line and at most `lines`.
  void drain(const Line& line, std::size_t most = ~std::size_t{0});
  // Lines that did not fit since the last call.
  std::uint32_t take_lost() { return ring_.lost.exchange(0); }
  bool empty() const { return ring_.written.load(std::memory_order_acquire) == read_; }

 private:
  LogRing& ring_;
  std::uint64_t read_ = 0;
  std::string text_;
};

}  // namespace lockstep::host
