#include "study/folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "study/plan_json.h"
#include "study/row_reader.h"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

StudyFolder::~StudyFolder() {
  if (runs_ >= 0) close(runs_);
}

std::string StudyFolder::file(std::string_view name) const {
  return path_ + '/' + std::string(name);
}

bool StudyFolder::fail(std::string what) {
  error_ = std::move(what);
  return false;
}

// Nothing in it but, perhaps, a study.json that a kill has kept from its name.
bool StudyFolder::is_free() {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) return fail(fmt::format("cannot make the directory '{}': {}", path_, error.message()));
  for (const auto& entry : fs::directory_iterator(path_, error)) {
    if (entry.path().filename() == "study.json.new") continue;
    return fail(fmt::format("'{}' is not empty and not a study, expected a new directory", path_));
  }
  return !error || fail(fmt::format("cannot read '{}': {}", path_, error.message()));
}

// A kill leaves the old file or the new one, never a half.
bool StudyFolder::write_whole(const std::string& name, std::string_view text) {
  const std::string path = file(name), fresh = path + ".new";
  const int out = open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const bool written = out >= 0 && write_all(out, text);
  const bool closed = out >= 0 && close(out) == 0;
  if (written && closed && rename(fresh.c_str(), path.c_str()) == 0) return true;
  return fail(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
}

bool StudyFolder::open_runs(std::uint64_t keep) {
  const std::string path = file("runs.csv");
  runs_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (runs_ < 0) return fail(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  if (flock(runs_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return fail(fmt::format("another process is writing the study in '{}'", path_));
  }
  if (ftruncate(runs_, static_cast<off_t>(keep)) == 0) return true;
  return fail(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
}

std::optional<StudyPlan> StudyFolder::read_plan() {
  const std::string path = file("study.json");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) {
    fail(fmt::format("'{}' is not a study: it has no study.json", path_));
    return std::nullopt;
  }
  std::string reason;
  auto plan = plan_from_json(text.str(), reason);
  if (!plan) fail(fmt::format("'{}' is not a study's: {}", path, reason));
  return plan;
}

std::optional<std::uint64_t> StudyFolder::begin(const StudyPlan& plan, bool resume) {
  std::uint64_t rows = 0, bytes = 0;
  if (fs::exists(file("study.json"))) {
    if (!resume) {
      fail(
          fmt::format("there is a study in '{}' already; go on with it by --resume, or choose "
                      "another directory by --out",
                      path_));
      return std::nullopt;
    }
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
      return std::nullopt;
    }
    rows = reader.rows();
    bytes = reader.bytes();
  } else if (!is_free() || !write_whole("study.json", to_json(plan))) {
    return std::nullopt;
  }
  if (!open_runs(bytes) || (bytes == 0 && !append(row_header(plan)))) return std::nullopt;
  return rows;
}

bool StudyFolder::append(std::string_view lines) {
  if (write_all(runs_, lines)) return true;
  return fail(fmt::format("cannot write '{}': {}", file("runs.csv"), std::strerror(errno)));
}

std::optional<std::vector<SummaryRow>> StudyFolder::finish(const StudyPlan& plan) {
  auto rows = summarize_runs(file("runs.csv"), plan, error_);
  if (!error_.empty() || !write_whole("summary.csv", summary_csv(plan, rows))) return std::nullopt;
  return rows;
}

}  // namespace lockstep
