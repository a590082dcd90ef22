// A file that only grows, written by a thread of its own: whoever has something to write never
// waits for the disk, nor for numbers to become text. Between the two is a queue of packets, of
// fixed size; what does not fit is refused. Whole lines are written, so that a file cut by a kill
// can be read up to its last whole line. The first error ends the writing.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/output_file.h"
#include "recording/write/bell.h"
#include "recording/write/packet_ring.h"

namespace lockstep {

class AppendFile {
 public:
  static constexpr std::size_t kQueue = 8u << 20;  // bytes
  // A packet is written at the latest so long after push(), or when so much is collected, or half
  // of what the queue takes.
  static constexpr std::chrono::milliseconds kLongestDelay{100};
  static constexpr std::size_t kFull = 64u << 10;  // bytes
  static constexpr std::size_t kText = 64u << 10;  // bytes that are written at once
  static constexpr std::chrono::milliseconds kLongestEmergency{500};

  // Creates the file; error() tells when that is not possible. It takes its name, and the place of
  // what has it, when the first line is in it: core/output_file.h.
  explicit AppendFile(const std::string& path, std::size_t queue = kQueue);
  // Flushes.
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  // One thread at a time calls these three. A packet is of whole lines: its text ends in '\n'.

  // Never waits. False: the queue is full, or writing has failed; nothing was taken.
  bool push(const Packet& packet);
  // Returns when it is written, or writing has failed. It may be longer than the queue.
  void write(const Packet& packet);
  // Returns when all is written, or writing has failed.
  void flush();

  bool failed() const { return failed_.load(std::memory_order_acquire); }
  // "" while all is well, else "cannot write 'x': No space left on device".
  const std::string& error() const;

  // For a crash handler, on any thread: async-signal-safe. Has what was pushed to any file of this
  // process written out, by its thread or, when that does not answer, right here. Gives up after
  // kLongestEmergency on a disk that does not take it.
  static void emergency_flush();

 private:
  enum class Failure { Told, Silent };

  void write_until_stopped();
  void write_out(Failure failure);
  void write_text(std::string_view text, Failure failure);
  void count_written(std::string_view text);
  void give_up(const char* what, Failure failure);
  void cut_back();
  void fail(const char* what);
  void save(std::chrono::nanoseconds deadline);
  bool claim();
  void release();

  PacketRing ring_;
  const std::string path_;
  OutputFile out_;
  const int file_;
  std::string error_;  // not touched any more once failed_
  std::atomic<bool> failed_{false};

  std::uint64_t called_for_ = 0;  // bytes that had been pushed when the thread was last woken
  Bell work_;                     // for the thread
  Bell done_;                     // of the thread
  std::atomic<bool> stopping_{false};

  // The thread that takes packets out and writes them; 0: none. So no byte is written twice.
  std::atomic<pid_t> claim_{0};
  std::vector<char> text_;     // what it prints to
  std::uint64_t written_ = 0;  // bytes of the text of the packets in the ring, in the file already
  std::uint64_t unfinished_ = 0;  // bytes at the end of the file that are not a whole line
  std::thread thread_;
};

}  // namespace lockstep
