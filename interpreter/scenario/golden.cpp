#include "scenario/golden.h"

#include <sys/stat.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/system/output_file.h"
#include "base/system/replace_text.h"
#include "language/document/file.h"
#include "record/header_line.h"
#include "record/read/recording_parts.h"
#include "record/use/recording_diff.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

// A recording that is removed again.
class BriefRecording {
 public:
  BriefRecording() {
    std::string name = (std::filesystem::temp_directory_path() / "lockstep-test-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) directory_ = name;
  }
  ~BriefRecording() {
    std::error_code error;
    if (!directory_.empty()) std::filesystem::remove_all(directory_, error);
  }
  BriefRecording(const BriefRecording&) = delete;
  BriefRecording& operator=(const BriefRecording&) = delete;

  std::string path(const std::string& ending = ".jsonl") const {
    return directory_ + "/run" + ending;
  }

 private:
  std::string directory_;
};

// The first lines of a difference.
std::vector<std::string> first_lines(const std::string& text) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (lines.size() == kMost) {
      lines.emplace_back("…");
      break;
    }
    lines.push_back(line);
  }
  return lines;
}

// A link, and a name that is written in another way, are the same file.
std::string without_links(const std::string& path) {
  std::error_code error;
  const fs::path found = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path : found.string();
}

bool is_below(const fs::path& folder, const fs::path& path) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

bool is_recording(const std::string& path) {
  const auto line = header_line(path);
  return line && line->starts_with(kHeaderBegin);
}

// The same of all names of one file, also of hard links.
std::string identity_of(const std::string& path) {
  struct stat file {};
  const bool is_file = stat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode);
  return is_file ? fmt::format("{}:{}", file.st_dev, file.st_ino) : path;
}

// A recording with which a run is compared.
struct Compared {
  const std::string& file;
  std::string label;  // in the lines that differ: "golden.jsonl"
  std::string name;   // in messages: "'golden.jsonl'"
};

void compare_run(const Golden& run_of, const Compared& with, std::vector<Surprise>& surprises) {
  const Expectation& expected = run_of.expected;
  const BriefRecording brief;
  ScenarioRunOptions again = run_of.options;
  again.record = brief.path();
  static_cast<void>(run_of.runner.run(again));
  NamedRecording golden_file(with.file);
  std::ifstream this_file(brief.path());
  if (!golden_file.is_open()) {
    surprises.push_back({expected.place,
                         fmt::format("{} cannot be read", with.name),
                         {"lockstep test --update writes it"}});
    return;
  }
  RecordingReader expected_run(golden_file.text(), with.file), run(this_file, "this run");
  // The ticks of a run on the wall clock were as late as they were: a run repeats the others.
  const bool is_of_wall = expected_run.error().empty() && expected_run.header().clock == "wall";
  RecordingDiff diff = host::compare(expected_run, run,
                                     {.tolerance = expected.tolerance, .ignore_time = is_of_wall});
  // Each run of a scenario has its own seed; what it changes is in the ticks.
  std::erase_if(diff.header, [&](const ValueDifference& it) {
    return it.what == "seed" || (is_of_wall && it.what == "clock");
  });
  if (!expected_run.error().empty() || !run.error().empty()) {
    const std::string& error = expected_run.error().empty() ? run.error() : expected_run.error();
    surprises.push_back({expected.place, error, {}});
  } else if (!diff.same()) {
    const std::string text = to_text(diff, with.label, "this run", false);
    surprises.push_back(
        {expected.place, fmt::format("the run is not that of {}", with.name), first_lines(text)});
  }
}

// What people keep is replaced as it is: its owner, its mode, its other names.
Result<void> write_golden(const std::string& path, const std::string& from) {
  constexpr std::size_t kMost = std::size_t{4} << 30u;
  std::error_code error;  // what is wrong, the writer says
  fs::create_directories(fs::path(path).parent_path(), error);
  const auto bytes = read_file(from, kMost);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!fs::exists(path, error)) return write_output(path, *bytes);
  const auto before = read_file(path, kMost);
  if (!before) return tl::unexpected(before.error());
  return replace_text(path, *before, *bytes);
}

}  // namespace

void Golden::compare(std::vector<Surprise>& surprises) const {
  const std::string& golden = expected.texts[0];
  // The writer of a pipe is not waited for.
  if (std::error_code none; fs::exists(golden, none) && !fs::is_regular_file(golden, none)) {
    surprises.push_back(
        {expected.place, fmt::format("'{}' is not a regular file", golden), {"name a recording"}});
    return;
  }
  compare_run(*this, {golden, golden, fmt::format("'{}'", golden)}, surprises);
}

bool GoldenUpdate::is_that_of_all() const {
  ScenarioRunOptions options = first_;
  std::vector<Surprise> differences;
  for (std::uint64_t run = 0; run < runs_ && differences.empty(); ++run, ++options.seed)
    Golden{runner_, expected_, options}.compare(differences);
  return differences.empty();
}

bool GoldenUpdate::is_same_in_all(const std::string& first, std::vector<Surprise>& surprises,
                                  std::uint64_t& seed) const {
  ScenarioRunOptions options = first_;
  for (std::uint64_t run = 1; run < runs_ && surprises.empty(); ++run) {
    seed = ++options.seed;
    compare_run({runner_, expected_, options}, {first, "run 1", "run 1"}, surprises);
  }
  if (surprises.empty()) return true;
  surprises.back().message += fmt::format(
      ": --update does not write '{}', which is the recording of several runs", expected_.texts[0]);
  return false;
}

bool GoldenUpdate::run(std::vector<Surprise>& surprises, std::uint64_t& seed) const {
  if (is_that_of_all()) return false;
  // All of it, before it takes the place of another one.
  const std::string path = without_links(expected_.texts[0]);
  const BriefRecording brief;
  ScenarioRunOptions again = first_;
  again.record = brief.path(path.ends_with(".zst") ? ".jsonl.zst" : ".jsonl");
  const ScenarioResult first = runner_.run(again);
  if (first.end.reason == StopReason::Signal) return false;
  seed = first_.seed;
  std::string problem = first.problem;
  if (problem.empty()) {
    if (!is_same_in_all(again.record, surprises, seed)) return false;
    const Result<void> written = write_golden(path, again.record);
    if (written) return true;
    problem = written.error().message;
  }
  surprises.push_back({expected_.place, problem, {}});
  return false;
}

GoldenFiles::GoldenFiles(const std::vector<const ScenarioFile*>& files) {
  for (const ScenarioFile* file : files) {
    for (const Scenario& scenario : file->scenarios) {
      for (const Expectation& it : scenario.expectations) {
        if (it.kind == Expectation::Kind::SameAs)
          users_[identity_of(without_links(it.texts[0]))].insert(&scenario);
      }
    }
  }
}

void GoldenFiles::check(const ScenarioFile& file, const Scenario& scenario,
                        std::vector<Diagnostic>& errors) const {
  const fs::path folder = fs::path(without_links(file.path)).parent_path();
  for (const Expectation& it : scenario.expectations) {
    if (it.kind != Expectation::Kind::SameAs) continue;
    const std::string path = without_links(it.texts[0]);
    const auto refuse = [&](std::string why, std::string hint) {
      errors.push_back(
          {.location = file.sources.locate_value(it.place),
           .message = fmt::format("--update does not write '{}': {}", it.texts[0], why),
           .hint = std::move(hint)});
    };
    if (!is_below(folder, path)) {
      refuse("it is not below the folder of the scenario file", "name a recording in that folder");
    } else if (fs::path(it.texts[0]).filename().empty()) {
      refuse("it names a folder", "name a file");
    } else if (path.ends_with(".mcap") || path.ends_with(".mcap.zst")) {
      refuse("a run is not compared with an MCAP file", "name it FILE.jsonl or FILE.jsonl.zst");
    } else if (fs::exists(path) && !(fs::is_regular_file(path) && is_recording(path))) {
      refuse("it is not a recording", "name another file, or remove this one");
    } else if (users_.at(identity_of(path)).size() > 1) {
      refuse("it is the recording of several scenarios", "name a file for each");
    }
  }
}

}  // namespace lockstep::host
