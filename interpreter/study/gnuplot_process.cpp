#include "study/gnuplot_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace lockstep {
namespace {

;

// Everything that the child inherits of us but does not want: signals that a run has blocked, our
// directory, our terminal.
class Child {
 public:
  explicit Child(const std::filesystem::path& directory, int out) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&actions_, directory.c_str());
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~Child() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // 0, or why not.
  int start(std::string script) {
    char program[] = "gnuplot", defaults[] = "-d";  // -d: not what the user's ~/.gnuplot says
    char* arguments[] = {program, defaults, script.data(), nullptr};
    return posix_spawnp(&pid_, program, &actions_, &attributes_, arguments, environ);
  }
  bool succeeds() const {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
  pid_t pid_ = -1;
};

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

GnuplotEnd run_gnuplot(const std::filesystem::path& directory, const std::string& script) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {.reason = errno};
  Child child(directory, ends[1]);
  const int reason = child.start("./" + script);
  close(ends[1]);
  if (reason != 0) {
    close(ends[0]);
    return {.reason = reason};
  }
  GnuplotEnd ended{.said = read_all(ends[0])};
  close(ends[0]);
  ended.ok = child.succeeds();
  return ended;
}

}  // namespace lockstep
