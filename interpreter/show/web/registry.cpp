#include "show/web/registry.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "base/core/value.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

// "" when there is none that only this user can write to.
std::string directory() {
  const char* runtime = secure_getenv("XDG_RUNTIME_DIR");
  const bool has_runtime = runtime != nullptr && *runtime == '/';
  const std::string path = has_runtime ? fmt::format("{}/lockstep", runtime)
                                       : fmt::format("/tmp/lockstep-{}", geteuid());
  mkdir(path.c_str(), S_IRWXU);
  struct stat status {};
  const bool is_ours = lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
                       status.st_uid == geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  return is_ours ? path : std::string();
}

// Whether the path is still that of this open file: between `open` and `flock`, another program may
// have removed it.
bool is_at(const FileDescriptor& file, const std::string& path) {
  struct stat opened {};
  struct stat found {};
  return fstat(file.number(), &opened) == 0 && lstat(path.c_str(), &found) == 0 &&
         opened.st_dev == found.st_dev && opened.st_ino == found.st_ino;
}

// False: its run has ended without being able to remove it, which is done here, or is about to lock
// it, and then makes it again.
bool is_locked(const std::string& path) {
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (file.number() < 0) return false;
  if (flock(file.number(), LOCK_SH | LOCK_NB) != 0) return true;
  if (flock(file.number(), LOCK_EX | LOCK_NB) == 0 && is_at(file, path)) unlink(path.c_str());
  return false;
}

// The file, locked by this program only; of no number if there can be none. Who lists the runs has
// a lock for a moment. Who has it for longer is a run with the same process number, in another
// container that shares the folder: a run does not wait for the end of that one.
FileDescriptor make_locked(const std::string& path) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
  constexpr int kMostTries = 100;
  constexpr timespec kPause{.tv_sec = 0, .tv_nsec = 1'000'000};
  for (int i = 0; i < kMostTries; ++i) {
    FileDescriptor file(open(path.c_str(), kFlags, S_IRUSR | S_IWUSR));
    if (file.number() < 0) break;
    if (flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
      nanosleep(&kPause, nullptr);
    } else if (is_at(file, path) && ftruncate(file.number(), 0) == 0) {
      return file;
    }
  }
  return FileDescriptor();
}

}  // namespace

std::vector<RegisteredRun> registered_runs() {
  std::vector<RegisteredRun> runs;
  const std::string path = directory();
  if (path.empty()) return runs;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const auto process = parse_int(entry.path().filename().string());
    if (!process) continue;
    if (!is_locked(entry.path())) continue;
    RegisteredRun run{
        .process = static_cast<pid_t>(*process), .link = {}, .tree_file = {}, .socket = {}};
    std::ifstream file(entry.path());
    if (std::getline(file, run.link) && std::getline(file, run.tree_file) &&
        std::getline(file, run.socket)) {
      runs.push_back(std::move(run));
    }
  }
  std::ranges::sort(runs, {}, &RegisteredRun::process);
  return runs;
}

Registration::Registration(const std::string& tree_file, const std::string& socket) {
  const std::string path = directory();
  if (path.empty()) return;
  path_ = fmt::format("{}/{}", path, getpid());
  file_ = make_locked(path_);
  if (file_.number() < 0) return;
  std::error_code error;
  tree_file_ = fs::absolute(tree_file, error).string();
  if (!socket.empty()) socket_ = fs::absolute(socket, error).string();
  set_link("");
}

std::string Registration::own_socket() {
  const std::string path = directory();
  return path.empty() ? path : fmt::format("{}/{}.socket", path, getpid());
}

void Registration::set_link(const std::string& link) {
  if (file_.number() < 0) return;
  const std::string text = fmt::format("{}\n{}\n{}\n", link, tree_file_, socket_);
  // Never shorter: who reads it meanwhile finds no rest of the text before.
  if (pwrite(file_.number(), text.data(), text.size(), 0) < 0) unlink(path_.c_str());
}

Registration::~Registration() {
  if (file_.number() >= 0) unlink(path_.c_str());
}

}  // namespace lockstep::host
