// The memory that a host and its leafhost share: one message at a time, in turns, and the rings of
// log lines. The side that waits for its turn spins for a moment, then sleeps on a futex. Does not
// know the content of the messages.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/core/clock.h"
#include "leaves/remote/shared_memory/log_ring.h"

namespace lockstep::host {

class Channel {
 public:
  // The largest message. Unused space needs no memory.
  static constexpr std::size_t kLargest = std::size_t{64} << 20;

  enum class Side : std::uint32_t { Host, Leafhost };

  // New memory, sealed so that the other side cannot shrink it; -1 on failure, with errno.
  static int create_memory();
  // False when `memory` is not what create_memory made; `side` is who we are.
  bool open(int memory, Side side);

  Channel() = default;
  ~Channel();
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  // Gives the turn to the other side. The message must not be larger than kLargest.
  void send(std::span<const std::byte> message);

  enum class Wait : std::uint8_t { Received, Late, Given_up };
  // Waits until it is our turn, this process has run for `limit`, or wake() was called after `gone`
  // became true.
  Wait wait(std::optional<Nanoseconds> limit, const std::atomic<bool>& gone);
  // Makes wait() check `gone`. May be called from any thread.
  void wake();

  // A copy of what the other side sent; nothing if it is not a message.
  std::optional<std::span<const std::byte>> received();
  // The lines that are logged by the thread that answers calls, and by all others.
  LogRing& call_log() { return control_->call_log; }
  LogRing& thread_log() { return control_->thread_log; }

 private:
  struct Control {
    std::uint64_t magic;
    alignas(64) std::atomic<std::uint32_t> turn;
    std::atomic<std::uint32_t> sleeps[2];
    std::atomic<std::uint64_t> length;
    alignas(64) LogRing call_log;
    alignas(64) LogRing thread_log;
  };
  bool is_mine() const;
  bool spin(const std::atomic<bool>& gone);
  bool spin_until(Nanoseconds end, const std::atomic<bool>& gone) const;
  bool reserve(std::size_t size);
  static std::size_t message_offset();

  Control* control_ = nullptr;
  std::byte* message_ = nullptr;  // as much of it as was needed so far
  std::size_t mapped_ = 0;
  Side side_ = Side::Host;
  Nanoseconds longest_spin_{0};
  Nanoseconds spin_time_{0};
  unsigned waits_ = 0;
  std::vector<std::byte> copy_;
};

}  // namespace lockstep::host
