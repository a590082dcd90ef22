// A file that only grows, written by a separate thread: callers wait neither for the disk nor for
// printing. Between the threads is a queue of packets of fixed size; a packet that does not fit is
// refused. Only whole lines are written, so a file cut by a kill can be read up to its last whole
// line. The first error ends the writing.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/core/clock.h"
#include "base/system/bell.h"
#include "base/system/lock_file.h"
#include "record/live/packet_ring.h"
#include "record/write/growing_file.h"

namespace lockstep::host {

// A recording in several files: record/part_names.h.
struct FileParts {
  bool are_wanted = false;
  std::uint64_t keep = 0;  // so many, the last ones; 0: all
  // Those of the processes before, in their order: they count, too.
  std::vector<std::string> before = {};
};

class AppendFile {
 public:
  static constexpr std::size_t kQueue = 8u << 20;  // bytes
  // A packet is written at most this long after push(), or as soon as this many bytes, or half of
  // the queue, are collected.
  static constexpr std::chrono::milliseconds kLongestDelay{100};
  static constexpr std::size_t kFull = 64u << 10;  // bytes
  static constexpr std::chrono::milliseconds kLongestEmergency{500};

  // Creates the file; on failure error() has the reason.
  explicit AppendFile(const std::string& path, std::size_t queue = kQueue, FileForm form = {},
                      FileParts parts = {});
  // The header for all parts. Before the first push().
  void set_header(std::string header) { header_ = std::move(header); }
  // Completes the file: end().
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  // Only one thread at a time may call these. A packet consists of whole lines: its text ends
  // in '\n'.

  // Never waits. Returns false if the queue is full or writing has failed; then the packet is not
  // stored.
  bool push(const Packet& packet);
  // Returns when the packet is written, or writing has failed. The packet may be longer than the
  // queue.
  void write(const Packet& packet);
  // Returns when everything is written, or writing has failed.
  void flush();
  // Completes the file: a compressed one or one of another format gets its last bytes only now, and
  // this may fail. Returns when it has them, or writing has failed. Nothing may be pushed after it.
  void end();
  // From now on, a pipe or a device that takes nothing for so long is an error. Before, it is
  // waited for without end. (The system lets nobody stop waiting for a disk.)
  void set_patience(Nanoseconds patience);
  bool ran_out_of_patience() const { return failed() && patience_.is_over; }

  // The part that is being written: its number, from 1 on, and how much of it is on the disk.
  std::uint64_t part() const { return part_.load(std::memory_order_acquire); }
  std::uint64_t part_size() const { return part_size_.load(std::memory_order_relaxed); }

  bool failed() const { return failed_.load(std::memory_order_acquire); }
  // "" if there is no error, else "cannot write 'x': No space left on device".
  const std::string& error() const;

  // For a crash handler, on any thread; async-signal-safe. Writes everything that was pushed to any
  // file of this process: its thread writes it or, if that thread does not answer, the caller.
  // Gives up after kLongestEmergency.
  static void emergency_flush();

 private:
  using Failure = GrowingFile::Failure;

  void write_until_stopped();
  void write_out(Failure failure);
  void begin_part(const PacketHead& head);
  void delete_oldest();
  void add_text(std::string_view text);
  void look_for_others();
  void remove_others();
  void take_failure();
  void fail(const std::string& error);
  void save(std::chrono::nanoseconds deadline);
  bool claim();
  void release();

  PacketRing ring_;
  Patience patience_;
  const std::string path_;
  const FileForm form_;
  const FileParts parts_;
  // Parts of two runs with one name would be mixed.
  std::optional<LockFile> lock_;
  std::string header_;
  std::unique_ptr<GrowingFile> file_;
  std::atomic<std::uint64_t> part_{1}, part_size_{0};
  bool is_between_parts_ = false;
  std::vector<std::string> others_;  // files of an earlier recording of this name
  bool has_removed_others_ = false;
  std::uint64_t deleted_ = 0;  // files, of those before and of the own parts
  std::string error_;          // constant once failed_ is set
  std::atomic<bool> failed_{false};

  std::uint64_t called_for_ = 0;  // bytes that had been pushed when the thread was last woken
  Bell work_;                     // for the thread
  Bell done_;                     // of the thread
  std::atomic<bool> stopping_{false};
  std::atomic<bool> in_crash_{false};  // the file is completed now, where only the thread can

  // The thread that takes packets out and writes them; 0: none. It prevents that a byte is written
  // twice.
  std::atomic<pid_t> claim_{0};
  std::atomic<bool> has_ended_{false};  // the file is complete
  std::vector<char> text_;              // what the thread prints to
  std::uint64_t written_ = 0;  // bytes of the text of the packets in the ring, in the file already
  std::thread thread_;
};

}  // namespace lockstep::host
