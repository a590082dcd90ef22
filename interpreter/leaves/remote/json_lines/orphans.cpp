#include "leaves/remote/json_lines/orphans.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace lockstep::host {
namespace {

constexpr const char* kMark = "LOCKSTEP_GUARDIAN";

bool is_marked(pid_t process, pid_t guardian) {
  std::ifstream file(fmt::format("/proc/{}/environ", process), std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  const std::string mark = fmt::format("{}={}", kMark, guardian);
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find('\0', begin), all.size());
    if (all.compare(begin, end - begin, mark) == 0) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

std::vector<pid_t> own_children() {
  std::vector<pid_t> children;
  std::error_code error;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::ifstream file(thread.path() / "children");
    for (pid_t child = 0; file >> child;) children.push_back(child);
  }
  return children;
}

void take_over_orphans() {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void mark_own_orphans() {
  setenv(kMark, fmt::format("{}", getpid()).c_str(), 1);
}

// A process that is killed leaves its children to us, too, until there are none.
void end_orphans_of(pid_t guardian, pid_t group) {
  if (group <= 0) return;
  kill(-group, SIGKILL);
  for (bool has_more = true; has_more;) {
    // First: one that is dying has no environment any more, but still has children.
    while (waitpid(-group, nullptr, 0) > 0) {
    }
    has_more = false;
    for (const pid_t child : own_children()) {
      if (child == guardian || !is_marked(child, guardian)) continue;
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
      has_more = true;
    }
  }
}

}  // namespace lockstep::host
