#include "scenario/golden.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "compression/decompressed.h"
#include "recording/use/recording_diff.h"

namespace lockstep::host {
namespace {

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

  std::string path() const { return directory_ + "/run.jsonl"; }

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

}  // namespace

void Golden::compare(std::vector<Surprise>& surprises) const {
  const std::string& golden = expected.texts[0];
  const BriefRecording brief;
  PerformOptions again = options;
  again.record = brief.path();
  const Performance performance = performer.perform(again);
  DecompressedFile golden_file(golden);
  std::ifstream this_file(brief.path());
  if (!golden_file.is_open()) {
    surprises.push_back({expected.place,
                         fmt::format("'{}' cannot be read", golden),
                         {"lockstep test --update writes it"}});
    return;
  }
  RecordingReader expected_run(golden_file.text(), golden), run(this_file, "this run");
  const RecordingDiff diff =
      host::compare(expected_run, run, {.tolerance = expected.tolerance, .ignore_time = false});
  if (!expected_run.error().empty() || !run.error().empty()) {
    const std::string& error = expected_run.error().empty() ? run.error() : expected_run.error();
    surprises.push_back({expected.place, error, {}});
  } else if (!diff.same()) {
    surprises.push_back({expected.place, fmt::format("the run is not that of '{}'", golden),
                         first_lines(to_text(diff, golden, "this run", false))});
  }
}

bool Golden::update(std::vector<Surprise>& surprises) const {
  std::vector<Surprise> differences;
  compare(differences);
  if (differences.empty()) return false;
  PerformOptions again = options;
  again.record = expected.texts[0];
  const Performance performance = performer.perform(again);
  if (performance.problem.empty()) return true;
  surprises.push_back({expected.place, performance.problem, {}});
  return false;
}

}  // namespace lockstep::host
