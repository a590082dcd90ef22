// The program from outside: what it prints and how it ends. No shell stands between.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "support/paths.h"
#include "support/text.h"

namespace lockstep::host::test {

struct Outcome {
  int code = -1;  // 128 + the signal when one killed it
  std::string out;
  std::string err;
  bool terminal_is_raw = false;  // does not show what is typed, as the program has left it
  double cpu_seconds = 0;
  double peak_megabytes = 0;  // resident
};

struct Invocation {
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment = {};  // over ours; NO_COLOR and such are unset
  std::string input = {};
  std::string program = LOCKSTEP_BINARY_DIR "/lockstep";
};

Outcome run(const Invocation& call);
// lockstep with these arguments.
Outcome run_lockstep(std::vector<std::string> arguments);

// The program while it runs.
class Process {
 public:
  enum class Output { Pipes, Terminal };  // a terminal is both out and err: all is in `out`

  explicit Process(const Invocation& call, Output output = Output::Pipes);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // Reads on until its output holds `text`; false when it ended without.
  bool wait_for(const std::string& text);
  // Reads what comes next; false at the end.
  bool read_on() { return read_more(); }
  pid_t id() const { return pid_; }
  void signal(int number) const { kill(pid_, number); }
  // Until it has been stopped by a signal.
  void wait_for_stop() const;
  // Keys on its terminal.
  void type(const std::string& keys) const;
  // Another size of its terminal.
  void resize(unsigned short rows, unsigned short columns) const;
  // What it has printed as far as it was read.
  const Outcome& so_far() const { return outcome_; }
  // Forgets what it has printed so far.
  void clear_output() { outcome_ = {}; }
  Outcome finish();
  // The same after the signal, which is sent again where it may have been lost.
  Outcome end_by(int number);

 private:
  bool has_more(int milliseconds) const;  // or the end
  bool read_more();                       // false at the end of both

  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  Outcome outcome_;
};

// The writing end of a pipe, for a program to inherit: full, and nobody reads it, or nobody can.
class DeadEnd {
 public:
  enum class Reader { Gone, Stuck };
  explicit DeadEnd(Reader reader);
  ~DeadEnd();
  DeadEnd(const DeadEnd&) = delete;
  DeadEnd& operator=(const DeadEnd&) = delete;
  // The number of the descriptor, for a shell.
  std::string number() const { return std::to_string(ends_[1]); }

 private:
  int ends_[2] = {-1, -1};
};

// A directory of its own that is removed in the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  std::string path(const std::string& name) const { return path_ + "/" + name; }
  // Writes a file and returns its path.
  std::string file(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

// Runs a script of bash in the directory; `lockstep` is that of this build.
Outcome shell(const std::string& script, const TemporaryDirectory& directory);

std::string read_file(const std::string& path);
// The path of a plugin of tests/abi/plugins.
std::string abi_plugin(const std::string& name);

// A file of /proc/ID. Empty if that process has ended, be it while it is read.
std::string read_process_file(pid_t process, const std::string& name);
// <root>, the plugin motion, and a BehaviorTree 'Main' around `node`.
std::string tree_text(const std::string& node);
std::vector<std::string> lines(const std::string& text);
}  // namespace lockstep::host::test
