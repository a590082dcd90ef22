#include "study/folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/descriptors.h"
#include "study/plan_json.h"
#include "study/row_reader.h"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

// A file that is not there yet. 0, or why not.
int write_new(const std::string& path, std::string_view text) {
  const int out = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (out < 0) return errno;
  const int reason = write_all(out, text) ? 0 : errno;
  return close(out) == 0 || reason != 0 ? reason : errno;
}

}  // namespace

std::string StudyFolder::file(std::string_view name) const {
  return path_ + '/' + std::string(name);
}

bool StudyFolder::fail(std::string what) {
  error_ = std::move(what);
  return false;
}

bool StudyFolder::fail_to_write(std::string_view name, int reason) {
  return fail(fmt::format("cannot write '{}': {}", file(name), std::strerror(reason)));
}

bool StudyFolder::is_there() const {
  std::error_code error;
  return fs::exists(fs::symlink_status(file("study.json"), error));
}

// Nothing in it but, perhaps, what a kill leaves before study.json has its name.
bool StudyFolder::is_free() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const auto name = entry.path().filename();
    std::error_code unknown;
    if (name == "study.json.new" || (name == "runs.csv" && entry.file_size(unknown) == 0)) continue;
    return fail(fmt::format("'{}' is not empty and not a study, expected a new directory", path_));
  }
  return !error || fail(fmt::format("cannot read '{}': {}", path_, error.message()));
}

// Before it nothing is written: what is seen there may be the beginning of another process.
bool StudyFolder::lock() {
  const std::string path = file("runs.csv");
  constexpr int kNew = O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  runs_ = FileDescriptor(open(path.c_str(), kNew, 0666));
  struct stat status {};
  if (runs_.number() < 0 || fstat(runs_.number(), &status) != 0)
    return fail_to_write("runs.csv", errno);
  if (!S_ISREG(status.st_mode))
    return fail(fmt::format("cannot write '{}': it is not a regular file", path));
  // A file system without locks is taken as it is.
  if (flock(runs_.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
  return fail(fmt::format("another process is writing the study in '{}'", path_));
}

// A kill leaves the old file or the new one, never a half.
bool StudyFolder::write_whole(const std::string& name, std::string_view text) {
  const std::string path = file(name), fresh = path + ".new";
  unlink(fresh.c_str());  // of a process that was killed, or a link that leads elsewhere
  int reason = write_new(fresh, text);
  if (reason == 0 && rename(fresh.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return true;
  unlink(fresh.c_str());
  return fail_to_write(name, reason);
}

std::optional<StudyPlan> StudyFolder::read_plan() {
  constexpr std::uintmax_t kLargest = std::uintmax_t{512} << 20u;
  const std::string path = file("study.json");
  std::error_code error;
  const bool readable = fs::is_regular_file(path, error) && fs::file_size(path, error) <= kLargest;
  std::ifstream in(readable ? path : std::string(), std::ios::binary);
  std::ostringstream text;
  if (!readable || !(text << in.rdbuf())) {
    fail(fmt::format("'{}' is not a study: it has no study.json that can be read", path_));
    return std::nullopt;
  }
  auto plan = plan_from_json(text.str());
  if (plan) return std::move(*plan);
  fail(fmt::format("'{}' is not a study's: {}", path, plan.error().message));
  return std::nullopt;
}

bool StudyFolder::make(const StudyPlan& plan) {
  return is_free() && write_whole("study.json", to_json(plan)) && append(row_header(plan));
}

std::optional<RowSequence> StudyFolder::take_over(const StudyPlan& plan) {
  const auto there = read_plan();
  if (!there) return std::nullopt;
  if (const auto key = first_difference(plan, *there, true); !key.empty()) {
    fail(fmt::format("the study in '{}' is another one: its '{}' differs", path_, key));
    return std::nullopt;
  }
  RowReader reader(file("runs.csv"), plan);
  while (!reader.next().empty()) continue;
  if (!reader.error().empty()) {
    fail(reader.error());
  } else if (ftruncate(runs_.number(), static_cast<off_t>(reader.bytes())) != 0) {
    fail_to_write("runs.csv", errno);
  } else if (reader.bytes() != 0 || append(row_header(plan))) {
    return reader.rows();
  }
  return std::nullopt;
}

std::optional<RowSequence> StudyFolder::begin(const StudyPlan& plan, bool resume) {
  std::error_code error;
  made_directory_ = fs::create_directories(path_, error);
  if (error) {
    fail(fmt::format("cannot create the directory '{}': {}", path_, error.message()));
    return std::nullopt;
  }
  // Not even an empty file is left in a directory of something else.
  if (!is_there() && !is_free()) return std::nullopt;
  if (resume || !is_there()) {
    if (!lock()) return std::nullopt;
    if (!is_there()) return make(plan) ? std::optional<RowSequence>(plan) : std::nullopt;
    if (resume) return take_over(plan);
  }
  fail(fmt::format(
      "there is a study in '{}' already; continue it with --resume, or choose another directory "
      "by --out",
      path_));
  return std::nullopt;
}

void StudyFolder::discard() {
  for (const char* name : {"runs.csv", "study.json"}) unlink(file(name).c_str());
  if (made_directory_) rmdir(path_.c_str());
}

bool StudyFolder::append(std::string_view lines) {
  if (write_all(runs_.number(), lines)) return true;
  return fail_to_write("runs.csv", errno);
}

std::optional<std::vector<SummaryRow>> StudyFolder::finish(const StudyPlan& plan) {
  auto rows = summarize_runs(file("runs.csv"), plan);
  if (!rows) {
    fail(rows.error().message);
    return std::nullopt;
  }
  if (!write_whole("summary.csv", summary_csv(plan, *rows))) return std::nullopt;
  return std::move(*rows);
}

}  // namespace lockstep
