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

#include "base/system/output_file.h"
#include "study/plan_json.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string StudyFolder::file(std::string_view name) const {
  return path_ + '/' + std::string(name);
}

bool StudyFolder::is_there() const {
  std::error_code error;
  return fs::exists(fs::symlink_status(file("study.json"), error));
}

// Nothing in it but, perhaps, what a kill leaves before study.json has its name.
Result<void> StudyFolder::check_free(const StudyPlan& plan) const {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    const auto name = entry.path().filename();
    std::error_code unknown;
    if (name == "study.json.new" ||
        (name == result_file_name(plan.rows) && entry.file_size(unknown) == 0))
      continue;
    return problem(
        fmt::format("'{}' is not empty and not a study, expected a new directory", path_));
  }
  if (error) return problem(fmt::format("cannot read '{}': {}", path_, error.message()));
  return {};
}

// Before it nothing is written: what is seen there may be the beginning of another process.
Result<void> StudyFolder::lock(const StudyPlan& plan) {
  const auto name = result_file_name(plan.rows);
  const std::string path = file(name);
  constexpr int kNew = O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  file_ = FileDescriptor(open(path.c_str(), kNew, 0666));
  struct stat status {};
  if (file_.number() < 0 || fstat(file_.number(), &status) != 0)
    return problem(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  if (!S_ISREG(status.st_mode))
    return problem(fmt::format("cannot write '{}': it is not a regular file", path));
  results_ = make_result_file({plan, path_, file_.number()});
  // A file system without locks is taken as it is.
  if (flock(file_.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return {};
  return problem(fmt::format("another process is writing the study in '{}'", path_));
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
  return check_free(plan)
      .and_then([&] { return write_output(file("study.json"), to_json(plan)); })
      .and_then([&] { return results_->take_over(); });
}

Result<void> StudyFolder::check_same(const StudyPlan& plan) const {
  const auto there = read_plan();
  if (!there) return tl::unexpected(there.error());
  const auto key = first_difference(plan, *there, true);
  if (key.empty()) return {};
  return problem(fmt::format("the study in '{}' is another one: its '{}' differs", path_, key));
}

Result<RowSequence> StudyFolder::begin(const StudyPlan& plan, bool resume) {
  std::error_code error;
  made_directory_ = fs::create_directories(path_, error);
  if (error) {
    return problem(fmt::format("cannot create the directory '{}': {}", path_, error.message()));
  }
  // Not even an empty file is left in a directory of something else.
  const auto free = !is_there() ? check_free(plan) : resume ? check_same(plan) : Result<void>();
  if (!free) return tl::unexpected(free.error());
  if (resume || !is_there()) {
    if (const auto locked = lock(plan); !locked) return tl::unexpected(locked.error());
    if (!is_there()) return make(plan);
    if (resume) return check_same(plan).and_then([&] { return results_->take_over(); });
  }
  return problem(fmt::format(
      "there is a study in '{}' already; continue it with --resume, or choose another directory "
      "by --out",
      path_));
}

void StudyFolder::discard(const StudyPlan& plan) {
  for (const std::string_view name : {result_file_name(plan.rows), std::string_view("study.json")})
    unlink(file(name).c_str());
  if (made_directory_) rmdir(path_.c_str());
}

Result<void> StudyFolder::append(std::string_view lines, std::span<const RowResult> rows) {
  return results_->add(lines, rows);
}

Result<void> StudyFolder::save() {
  return results_->save();
}

Result<std::vector<SummaryRow>> StudyFolder::finish(const StudyPlan& plan) {
  auto rows = summarize_study(file(result_file_name(plan.rows)), plan);
  if (!rows) return rows;
  return write_output(file("summary.csv"), summary_csv(plan, *rows)).map([&] {
    return std::move(*rows);
  });
}

}  // namespace lockstep::host
