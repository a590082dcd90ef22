#include "cli/tools/diff/git_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "base/core/wording.h"
#include "base/system/file_descriptor.h"
#include "language/document/document.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

// A file in memory, which a process can fill while nobody reads.
FileDescriptor file_in_memory(std::string_view text = {}) {
  FileDescriptor file(memfd_create("lockstep-git", MFD_CLOEXEC));
  while (!text.empty()) {
    const ssize_t written = write(file.number(), text.data(), text.size());
    if (written <= 0) return FileDescriptor();
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  lseek(file.number(), 0, SEEK_SET);
  return file;
}

std::string text_of(const FileDescriptor& file) {
  struct stat facts {};
  if (fstat(file.number(), &facts) != 0) return {};
  std::string text(static_cast<std::size_t>(facts.st_size), '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got =
        pread(file.number(), text.data() + size, text.size() - size, static_cast<off_t>(size));
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  text.resize(size);
  return text;
}

// Without a shell. What git writes; a Problem has what it says.
Result<std::string> git(const fs::path& folder, std::vector<std::string> words,
                        std::string_view input = {}) {
  words.insert(words.begin(), {"git", "-C", folder.string()});
  std::vector<char*> arguments;
  for (std::string& it : words) arguments.push_back(it.data());
  arguments.push_back(nullptr);
  const FileDescriptor in = file_in_memory(input), out = file_in_memory(), err = file_in_memory();
  if (in.number() < 0 || out.number() < 0 || err.number() < 0) {
    return problem(fmt::format("git cannot run: {}", std::strerror(errno)));
  }
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.number(), STDERR_FILENO);
  pid_t process = 0;
  const int wrong = posix_spawnp(&process, "git", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (wrong != 0) {
    return problem(fmt::format("git cannot run: {}", std::strerror(wrong)),
                   "install the package 'git', or give two files");
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return text_of(out);
  std::string said = text_of(err);
  said.resize(std::min(said.find('\n'), said.size()));
  for (const std::string_view before : {"fatal: ", "error: "}) {
    if (said.starts_with(before)) said.erase(0, before.size());
  }
  return problem("git: " + (said.empty() ? "it failed" : printable(said)));
}

std::string line_of(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

struct Blob {
  std::string id, path;
  bool is_link = false;
};

// Git itself makes no such path, but a repository may have one.
bool leads_out(const fs::path& path) {
  return path.is_absolute() || std::ranges::count(path, "..") != 0;
}

// Of `git ls-tree -r -z`: "100644 blob ID\tPATH". Links come last, so that nothing is written
// through one.
std::vector<Blob> xml_files(std::string_view list) {
  std::vector<Blob> files;
  while (!list.empty()) {
    const auto end = std::min(list.find('\0'), list.size());
    const std::string_view line = list.substr(0, end);
    list.remove_prefix(std::min(end + 1, list.size()));
    const auto tab = line.find('\t');
    const auto blob = line.find(" blob ");
    if (tab == std::string_view::npos || blob == std::string_view::npos || blob > tab) continue;
    const bool is_link = line.starts_with("120000");
    const std::string_view path = line.substr(tab + 1);
    // A link may lead to a folder.
    if ((!is_link && !path.ends_with(".xml")) || leads_out(path)) continue;
    files.push_back(
        {std::string(line.substr(blob + 6, tab - blob - 6)), std::string(path), is_link});
  }
  std::ranges::stable_partition(files, [](const Blob& it) { return !it.is_link; });
  return files;
}

bool write_text(const fs::path& path, std::string_view text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  return static_cast<bool>(file);
}

// Of `git cat-file --batch`: "ID blob SIZE\n", the bytes and a line end, for each file.
Result<void> write_files(const std::vector<Blob>& files, std::string_view all,
                         const fs::path& folder) {
  for (const Blob& it : files) {
    const auto end = all.find('\n');
    const auto blank = all.rfind(' ', end);
    std::size_t size = 0;
    if (end == std::string_view::npos || blank == std::string_view::npos ||
        std::from_chars(all.data() + blank + 1, all.data() + end, size).ec != std::errc() ||
        size > all.size() - end - 1) {
      return problem(fmt::format("git has no text of '{}'", brief(it.path)));
    }
    const std::string_view text = all.substr(end + 1, size);
    all.remove_prefix(std::min(end + size + 2, all.size()));
    const fs::path path = folder / it.path;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (it.is_link) {
      // One that leads out of the repository is none of the revision.
      const auto target = (fs::path(it.path).parent_path() / text).lexically_normal();
      const bool is_below = fs::weakly_canonical(path.parent_path(), error) == path.parent_path();
      if (!leads_out(target) && is_below) fs::create_symlink(fs::path(text), path, error);
    } else if (!write_text(path, text)) {
      return problem(
          fmt::format("'{}' cannot be written: {}", path.string(), std::strerror(errno)));
    }
  }
  return {};
}

// The nearest folder above a file that is there.
fs::path folder_above(const std::string& path) {
  std::error_code error;
  fs::path folder = fs::absolute(path, error).lexically_normal().parent_path();
  while (!fs::is_directory(folder, error) && folder != folder.parent_path()) {
    folder = folder.parent_path();
  }
  return folder;
}

}  // namespace

Result<GitFiles> GitFiles::read(const std::string& revision, const std::string& path) {
  if (is_privileged()) {
    return problem("git does not run: this program has more rights than its user");
  }
  const fs::path folder = folder_above(path);
  const auto top = git(folder, {"rev-parse", "--show-toplevel"});
  if (!top) return tl::unexpected(top.error());
  std::error_code error;
  const fs::path root = line_of(*top);
  const fs::path here = fs::weakly_canonical(folder, error);
  const fs::path rest = fs::absolute(path).lexically_normal().lexically_relative(folder);
  GitFiles files;
  files.revision_ = revision;
  files.below_ = (here.lexically_relative(root) / rest).lexically_normal();
  const auto id =
      git(root, {"rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{tree}"});
  if (!id) {
    return problem(fmt::format("git has no revision '{}'", brief(revision)),
                   "such as git:HEAD~1, git:main or git:v1.2");
  }
  const auto list = git(root, {"ls-tree", "-r", "-z", "--full-tree", line_of(*id)});
  if (!list) return tl::unexpected(list.error());
  const std::vector<Blob> blobs = xml_files(*list);
  if (std::ranges::find(blobs, files.below_.string(), &Blob::path) == blobs.end()) {
    return problem(fmt::format("the revision '{}' has no file '{}'", brief(revision),
                               brief(files.below_.string())),
                   "git:REV:PATH names a file that had another path, from the top of the "
                   "repository");
  }
  std::string ids;
  for (const Blob& it : blobs) ids += it.id + '\n';
  const auto texts = git(root, {"cat-file", "--batch"}, ids);
  if (!texts) return tl::unexpected(texts.error());
  std::string name = (fs::temp_directory_path() / "lockstep-diff-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    return problem(fmt::format("no folder for the files of git: {}", std::strerror(errno)));
  }
  files.folder_ = fs::canonical(name, error);
  if (const auto written = write_files(blobs, *texts, files.folder_); !written) {
    return tl::unexpected(written.error());
  }
  return files;
}

GitFiles::GitFiles(GitFiles&& other) noexcept
    : folder_(std::exchange(other.folder_, {})),
      below_(std::move(other.below_)),
      revision_(std::move(other.revision_)) {}

GitFiles::~GitFiles() {
  std::error_code error;
  if (!folder_.empty()) fs::remove_all(folder_, error);
}

std::string GitFiles::as_named(std::string text) const {
  const std::string before = folder_.string() + '/';
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos;) {
    text.replace(at, before.size(), revision_ + ':');
  }
  return text;
}

Diagnostics GitFiles::as_named(const Diagnostics& diagnostics) const {
  Diagnostics named;
  for (Diagnostic it : diagnostics.all()) {
    it.location.file = as_named(std::move(it.location.file));
    it.message = as_named(std::move(it.message));
    it.hint = as_named(std::move(it.hint));
    named.add(std::move(it));
  }
  return named;
}

}  // namespace lockstep::host
