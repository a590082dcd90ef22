#include "support/program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

extern char** environ;

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// What would change what a program prints, and is set on one machine and not on another.
constexpr const char* kUnset[] = {"NO_COLOR", "LC_ALL", "LC_CTYPE", "LANG", "LOCKSTEP_PLUGIN_PATH"};

std::vector<std::string> environment_of(const Invocation& call) {
  std::map<std::string, std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    all[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
  }
  for (const char* name : kUnset) all.erase(name);
  all["TERM"] = "xterm";
  for (const auto& [name, value] : call.environment) all[name] = value;
  std::vector<std::string> environment;
  for (const auto& [name, value] : all) environment.push_back(name + "=" + value);
  return environment;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
    read = ends[0];
    write = ends[1];
  }
};

bool is_raw(int terminal) {
  termios now{};
  return tcgetattr(terminal, &now) == 0 && (now.c_lflag & (ICANON | ECHO)) != (ICANON | ECHO);
}

// Appends what can be read at once; false at the end.
bool append(int file, std::string& text) {
  char buffer[65536];
  const ssize_t count = read(file, buffer, sizeof buffer);
  if (count <= 0) return false;  // a terminal whose program has ended gives EIO
  text.append(buffer, static_cast<std::size_t>(count));
  return true;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

}  // namespace

Process::Process(const Invocation& call, Output output) {
  std::vector<std::string> arguments{call.program};
  arguments.insert(arguments.end(), call.arguments.begin(), call.arguments.end());
  auto environment = environment_of(call);
  const auto argv = pointers(arguments);
  const auto envp = pointers(environment);
  if (output == Output::Terminal) {
    winsize size{40, 120, 0, 0};
    pid_ = forkpty(&out_, nullptr, nullptr, &size);
    if (pid_ == 0) {
      execvpe(argv[0], argv.data(), envp.data());
      _exit(127);
    }
    REQUIRE(pid_ > 0);
    return;
  }
  const Pipe in, out, err;
  pid_ = fork();
  if (pid_ == 0) {
    dup2(in.read, STDIN_FILENO);
    dup2(out.write, STDOUT_FILENO);
    dup2(err.write, STDERR_FILENO);
    execvpe(argv[0], argv.data(), envp.data());
    _exit(127);
  }
  REQUIRE(pid_ > 0);
  close(in.read);
  close(out.write);
  close(err.write);
  out_ = out.read;
  err_ = err.read;
  const ssize_t written = write(in.write, call.input.data(), call.input.size());
  close(in.write);
  REQUIRE(written == static_cast<ssize_t>(call.input.size()));
}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

bool Process::has_more(int milliseconds) const {
  if (out_ < 0 && err_ < 0) return true;
  pollfd files[] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
  return poll(files, 2, milliseconds) > 0;
}

bool Process::read_more() {
  pollfd files[] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};  // poll ignores a negative file
  if (out_ < 0 && err_ < 0) return false;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr int kPatience = 600'000;  // it takes ten times as long
#else
  constexpr int kPatience = 200'000;  // milliseconds; a build says nothing for a minute and more
#endif
  REQUIRE(poll(files, 2, kPatience) > 0);
  if (files[0].revents != 0 && !append(out_, outcome_.out)) {
    outcome_.terminal_is_raw = is_raw(out_);
    close(out_);
    out_ = -1;
  }
  if (files[1].revents != 0 && !append(err_, outcome_.err)) {
    close(err_);
    err_ = -1;
  }
  return true;
}

bool Process::wait_for(const std::string& text) {
  while (!contains(outcome_.out, text) && !contains(outcome_.err, text)) {
    if (!read_more()) return false;
  }
  return true;
}

void Process::wait_for_stop() const {
  siginfo_t info{};
  REQUIRE(waitid(P_PID, static_cast<id_t>(pid_), &info, WSTOPPED) == 0);
}

void Process::type(const std::string& keys) const {
  REQUIRE(write(out_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
}

void Process::resize(unsigned short rows, unsigned short columns) const {
  const winsize size{rows, columns, 0, 0};
  REQUIRE(ioctl(out_, TIOCSWINSZ, &size) == 0);
}

Outcome Process::finish() {
  while (read_more()) {
  }
  int status = 0;
  rusage used{};
  REQUIRE(wait4(pid_, &status, 0, &used) == pid_);
  pid_ = -1;
  outcome_.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  outcome_.peak_megabytes = static_cast<double>(used.ru_maxrss) / 1024;
  outcome_.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome_;
}

// A program that sleeps when a signal comes may never see it under the libtsan of g++ 12.
Outcome Process::end_by(int number) {
  signal(number);
#if defined(__SANITIZE_THREAD__)
  do {
    while (!has_more(5000)) signal(number);  // a second one would end it at once
  } while (read_more());
#endif
  return finish();
}

Outcome run(const Invocation& call) {
  return Process(call).finish();
}

Outcome run_lockstep(std::vector<std::string> arguments) {
  return run({.arguments = std::move(arguments)});
}

Outcome shell(const std::string& script, const TemporaryDirectory& directory) {
  return run({.arguments = {"-c", "cd \"$0\" && PATH=\"$1:$PATH\" && " + script, directory.path(""),
                            LOCKSTEP_BINARY_DIR},
              .program = "/bin/bash"});
}

std::string abi_plugin(const std::string& name) {
  return LOCKSTEP_BINARY_DIR "/tests/abi/plugins/" + name + ".so";
}

DeadEnd::DeadEnd(Reader reader) {
  REQUIRE(pipe(ends_) == 0);
  if (reader == Reader::Gone) {
    close(std::exchange(ends_[0], -1));
    return;
  }
  constexpr int kPage = 4096;
  REQUIRE(fcntl(ends_[1], F_SETPIPE_SZ, kPage) == kPage);
  const std::string page(kPage, '\n');
  REQUIRE(write(ends_[1], page.data(), page.size()) == kPage);
}

DeadEnd::~DeadEnd() {
  if (ends_[0] >= 0) close(ends_[0]);
  close(ends_[1]);
}

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (fs::temp_directory_path() / "lockstep-cli-XXXXXX").string();
  REQUIRE(mkdtemp(pattern.data()) != nullptr);
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code error;
  fs::remove_all(path_, error);
}

std::string TemporaryDirectory::file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string read_process_file(pid_t process, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(process) + "/" + name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string tree_text(const std::string& node) {
  return "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"Main\">" + node +
         "</BehaviorTree></root>\n";
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace lockstep::host::test
