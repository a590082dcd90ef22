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

#include "study/plan_json.h"
#include "study/row_reader.h"
#include "system/descriptors.h"

namespace lockstep::host {
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

tl::unexpected<Problem> StudyFolder::cannot_write(std::string_view name, int reason) const {
  return problem(fmt::format("cannot write '{}': {}", file(name), std::strerror(reason)));
}

bool StudyFolder::is_there() const {
  std::error_code error;
  return fs::exists(fs::symlink_status(file("study.json"), error));
}

// Nothing in it but, perhaps, what a kill leaves before study.json has its name.
Result<void> StudyFolder::check_free() const {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const auto name = entry.path().filename();
    std::error_code unknown;
    if (name == "study.json.new" || (name == "runs.csv" && entry.file_size(unknown) == 0)) continue;
    return problem(
        fmt::format("'{}' is not empty and not a study, expected a new directory", path_));
  }
  if (error) return problem(fmt::format("cannot read '{}': {}", path_, error.message()));
  return {};
}

// Before it nothing is written: what is seen there may be the beginning of another process.
Result<void> StudyFolder::lock() {
  const std::string path = file("runs.csv");
  constexpr int kNew = O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  runs_ = FileDescriptor(open(path.c_str(), kNew, 0666));
  struct stat status {};
  if (runs_.number() < 0 || fstat(runs_.number(), &status) != 0)
    return cannot_write("runs.csv", errno);
  if (!S_ISREG(status.st_mode))
    return problem(fmt::format("cannot write '{}': it is not a regular file", path));
  // A file system without locks is taken as it is.
  if (flock(runs_.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
  return problem(fmt::format("another process is writing the study in '{}'", path_));
}

// A kill leaves the old file or the new one, never a half.
Result<void> StudyFolder::write_whole(const std::string& name, std::string_view text) const {
  const std::string path = file(name), fresh = path + ".new";
  unlink(fresh.c_str());  // of a process that was killed, or a link that leads elsewhere
  int reason = write_new(fresh, text);
  if (reason == 0 && rename(fresh.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return {};
  unlink(fresh.c_str());
  return cannot_write(name, reason);
}

Result<StudyPlan> StudyFolder::read_plan() const {
  constexpr std::uintmax_t kLargest = std::uintmax_t{512} << 20u;
  const std::string path = file("study.json");
  std::error_code error;
  const bool readable = fs::is_regular_file(path, error) && fs::file_size(path, error) <= kLargest;
  std::ifstream in(readable ? path : std::string(), std::ios::binary);
  std::ostringstream text;
  if (!readable || !(text << in.rdbuf())) {
    return problem(
        fmt::format("'{}' is not a study: it has no study.json that can be read", path_));
  }
  auto plan = plan_from_json(text.str());
  if (plan) return plan;
  return problem(fmt::format("'{}' is not a study's: {}", path, plan.error().message));
}

Result<RowSequence> StudyFolder::make(const StudyPlan& plan) {
  return check_free()
      .and_then([&] { return write_whole("study.json", to_json(plan)); })
      .and_then([&] { return append(row_header(plan)); })
      .map([&] { return RowSequence(plan); });
}

Result<RowSequence> StudyFolder::take_over(const StudyPlan& plan) {
  const auto there = read_plan();
  if (!there) return tl::unexpected(there.error());
  if (const auto key = first_difference(plan, *there, true); !key.empty()) {
    return problem(fmt::format("the study in '{}' is another one: its '{}' differs", path_, key));
  }
  RowReader reader(file("runs.csv"), plan);
  while (!reader.next().empty()) continue;
  if (!reader.error().empty()) return problem(reader.error());
  if (ftruncate(runs_.number(), static_cast<off_t>(reader.bytes())) != 0) {
    return cannot_write("runs.csv", errno);
  }
  if (reader.bytes() != 0) return reader.rows();
  return append(row_header(plan)).map([&] { return reader.rows(); });
}

Result<RowSequence> StudyFolder::begin(const StudyPlan& plan, bool resume) {
  std::error_code error;
  made_directory_ = fs::create_directories(path_, error);
  if (error) {
    return problem(fmt::format("cannot create the directory '{}': {}", path_, error.message()));
  }
  // Not even an empty file is left in a directory of something else.
  const auto free = is_there() ? Result<void>() : check_free();
  if (!free) return tl::unexpected(free.error());
  if (resume || !is_there()) {
    if (const auto locked = lock(); !locked) return tl::unexpected(locked.error());
    if (!is_there()) return make(plan);
    if (resume) return take_over(plan);
  }
  return problem(fmt::format(
      "there is a study in '{}' already; continue it with --resume, or choose another directory "
      "by --out",
      path_));
}

void StudyFolder::discard() {
  for (const char* name : {"runs.csv", "study.json"}) unlink(file(name).c_str());
  if (made_directory_) rmdir(path_.c_str());
}

Result<void> StudyFolder::append(std::string_view lines) {
  if (write_all(runs_.number(), lines)) return {};
  return cannot_write("runs.csv", errno);
}

Result<std::vector<SummaryRow>> StudyFolder::finish(const StudyPlan& plan) {
  auto rows = summarize_runs(file("runs.csv"), plan);
  if (!rows) return rows;
  return write_whole("summary.csv", summary_csv(plan, *rows)).map([&] { return std::move(*rows); });
}

}  // namespace lockstep::host
