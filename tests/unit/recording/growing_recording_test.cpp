// A recording that is read while its run is cut and goes on in another file.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "record/read/recording_parts.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::TemporaryPath;

std::string piece(std::uint64_t first, std::uint64_t ticks) {
  return test::recorded_lines("Parallel(a b)", "a+.01 b+.02", first, ticks);
}

// All that there is until now.
std::string read_on(std::istream& in) {
  in.clear();
  std::ostringstream text;
  for (char c = 0; in.get(c);) text << c;
  return text.str();
}

}  // namespace

TEST_CASE("a reader goes on with the file of the process that continues its run") {
  struct Case {
    std::uint64_t resumed;
    std::string rest, between;
  };
  // The run may continue behind the last line, after ticks without a line, or before ticks that
  // have been read; and the last line may be cut.
  for (const Case& it :
       {Case{6, "", "{\"continued\":{\"ticks\":6}}\n"},
        Case{8, "", "{\"lost\":{\"ticks\":2,\"from\":6}}\n{\"continued\":{\"ticks\":8}}\n"},
        Case{4, "", "{\"continued\":{\"ticks\":4}}\n"},
        Case{6, "{\"tick\":6,\"ti", "\n{\"continued\":{\"ticks\":6}}\n"}}) {
    INFO(it.resumed << it.rest);
    const TemporaryPath place;  // run.jsonl in a folder of its own
    const auto folder = std::filesystem::path(place.path()).parent_path() / "growing";
    std::filesystem::create_directories(folder);
    const std::string first = piece(0, 6) + it.rest, second = piece(it.resumed, it.resumed + 3);
    std::ofstream(folder / "run.jsonl") << first;
    NamedRecording recording((folder / "run.jsonl").string(), NamedRecording::Reading::Follows);
    REQUIRE(recording.is_open());
    CHECK(read_on(recording.text()) == first);
    CHECK(read_on(recording.text()).empty());
    // The header of the next process is not there at once.
    std::ofstream(folder / "run.resumed-1.jsonl") << second.substr(0, 40);
    CHECK(read_on(recording.text()).empty());
    std::ofstream(folder / "run.resumed-1.jsonl") << second;
    CHECK(read_on(recording.text()) == it.between + second);
    std::ofstream(folder / "run.resumed-1.jsonl", std::ios::app) << "more\n";
    CHECK(read_on(recording.text()) == "more\n");
  }
}

}  // namespace lockstep::host
