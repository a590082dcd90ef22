// A program as a process: its guardian, the pipes to and from it, and signals to its group. Knows
// nothing about what is said.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

#include "base/core/running_time.h"
#include "base/system/file_descriptor.h"
#include "base/system/mutex.h"
#include "leaves/remote/child_process.h"
#include "leaves/remote/json_lines/line_input.h"

namespace lockstep::host {

class ProgramProcess {
 public:
  // Starts the program in `path`, under a guardian, which is `leafhost`. "" or why it does not
  // start.
  std::string start(const std::string& leafhost, const std::string& path);
  bool has_started();
  ProgramProcess() = default;
  // Ends what is left of it.
  ~ProgramProcess();
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  static constexpr std::size_t kMostUnwritten = std::size_t{4} << 20;
  // Never waits: what the program does not take now is kept for the next call. TooMuch: more
  // than kMostUnwritten waits, and the program has read nothing for a while. Deaf: its input is
  // closed.
  enum class Written { Good, TooMuch, Deaf };
  Written write(std::string_view text);
  bool has_unwritten() const { return !unwritten_.empty(); }
  // It can read the end of its input.
  void close_input();

  // The descriptor that it writes to. `lines.fill(output())` takes what is there.
  int output() const { return output_.number(); }
  // Waits until there is output, or its end, or that of the process, or room for what was not
  // written yet, at most so long. False: there is none yet.
  bool await_output(std::optional<Nanoseconds> patience) const;
  // Readable when the process has ended; what it has started may still hold its output open.
  int end() const { return control_.number(); }
  bool has_ended() const;
  LineInput lines;

  // To its process group. Any thread.
  void hold() { signal(SIGSTOP); }
  void go_on() { signal(SIGCONT); }
  // TERM, CONT, and KILL after `limit`, if any.
  void end_softly(std::optional<Nanoseconds> limit);
  void kill() { signal(SIGKILL); }
  // Waits at most so long for its end: how it ended, or nothing.
  std::optional<std::string> await_end(std::optional<Nanoseconds> patience);
  // Ends what is left of it, and waits for that: not even a zombie stays.
  void bury();

 private:
  void signal(int number);

  ChildProcess guardian_;
  FileDescriptor control_, input_, output_;
  std::string unwritten_;
  RunningClock clock_;
  Nanoseconds taken_{0};  // when there was nothing unwritten, or the program took some of it
  Mutex mutex_;  // for signals from any thread: the group is there until the end of control_
  pid_t group_ LOCKSTEP_GUARDED_BY(mutex_) = -1;
  std::optional<std::string> end_;
  bool is_buried_ = false;
};

}  // namespace lockstep::host
