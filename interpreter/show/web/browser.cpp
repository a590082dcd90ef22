#include "show/web/browser.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>

namespace lockstep::host {
namespace {

// It gets none of our signals, and prints nothing between our messages.
struct Manners {
  Manners() {
    posix_spawn_file_actions_init(&files);
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_RDWR, 0);
    }
    posix_spawnattr_init(&attributes);
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(
        &attributes,
        static_cast<short>(POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSID));
  }
  ~Manners() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  Manners(const Manners&) = delete;
  Manners& operator=(const Manners&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

}  // namespace

bool open_in_browser(const std::string& link) {
  if (secure_getenv("PATH") == nullptr) return false;  // who chooses it would choose what runs
  const Manners manners;
  std::string program = "xdg-open", argument = link;
  char* const words[] = {program.data(), argument.data(), nullptr};
  pid_t process = 0;
  return posix_spawnp(&process, program.c_str(), &manners.files, &manners.attributes, words,
                      environ) == 0;
}

}  // namespace lockstep::host
