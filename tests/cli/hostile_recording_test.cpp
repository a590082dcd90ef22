// Recordings that are meant to break their readers. Each is refused with its line, or read, and a
// line takes a few times its length in memory, whatever is in it.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMaxReadSeconds = 60, kMaxTimes = 100;
#else
constexpr double kMaxReadSeconds = 5, kMaxTimes = 17;
#endif
constexpr double kAlways = 40;  // MB, whatever is read
constexpr std::size_t kMegabytes = 4;

const std::string kHeadLines =
    R"({"lockstep_recording":1,"tree":"M","file":"f","version":"0","rate_hz":100.0,)"
    R"("clock":"virtual","seed":0,"arguments":{)";
const std::string kNode = R"({"index":0,"path":"M/W","kind":"W","name":"W","parent":null)";
const std::string kHeader = kHeadLines + R"(},"nodes":[)" + kNode + "}]}\n";
const std::string kTick = R"({"tick":0,"time_s":0,"nodes":[)";

// A recording with one line of kMegabytes: after `begin` come as many of `part` as fit, and then
// `end`. In a part, {0} is its number and {1} the one before it.
struct HostileRecording {
  std::string name, begin, part, end;
  std::string error;  // in stderr; "" when the line can be read
};

const std::vector<HostileRecording> kRecordings{
    {"a status that is a list of lists of lists", kHeader + kTick + "[0,", "[", "}",
     "'s change has a status that is not a string"},
    {"lists in lists under a key that is not known", kHeader + kTick + "],\"x\":", "[", "}",
     "nested deeper than"},
    {"objects in objects", kHeader + kTick + "],\"x\":", "{\"\":", "}", "nested deeper than"},
    {"a list of numbers", kHeader + kTick + "],\"x\":[0", ",0", "]}", ""},
    {"a list of lists", kHeader + kTick + "],\"x\":[[]", ",[]", "]}", ""},
    {"keys that are not known", kHeader + kTick + "]", ",\"x{0}\":0", "}", ""},
    {"a long text", kHeader + kTick + "],\"x\":\"", "xxxx", "\"}", ""},
    {"a long status", kHeader + kTick + "[0,\"", "xxxx", "\",0,0,0]]}", "no status 'xxx"},
    {"a long key", kHeader + "{\"", "xxxx", "\":0}", "'tick' is missing"},
    {"a long number", kHeader + "{\"tick\":", "1111", ",\"time_s\":0,\"nodes\":[]}",
     "'tick' is not a whole number"},
    {"a long fraction", kHeader + "{\"tick\":0,\"time_s\":0.", "1111", ",\"nodes\":[]}", ""},
    {"changes", kHeader + kTick + "[0,\"idle\",0,0,0]", ",[0,\"idle\",0,0,0]", "]}", ""},
    {"faults", kHeader + kTick + "],\"faults\":[[0,\"\"]", ",[0,\"\"]", "]}", ""},
    {"succeeded", kHeader + kTick + "],\"succeeded\":[0", ",0", "]}", ""},
    {"notes",
     kHeader + R"({"end":{"result":"","reason":"","ticks":0,"time_s":0,"overruns":0,"skipped":0,)" +
         R"("notes":["")",
     ",\"\"", "]}}", ""},
    {"a long fault", kHeader + kTick + "],\"faults\":[[0,\"", "\\u0001", "\"]]}", ""},
    {"arguments", kHeadLines + "\"\":\"\"", ",\"{0:x}\":\"\"", "},\"nodes\":[" + kNode + "}]}", ""},
    {"barriers", kHeadLines + "},\"nodes\":[" + kNode + ",\"barriers\":[0", ",0", "]}]}", ""},
    {"nodes", kHeadLines + "},\"nodes\":[" + kNode + "}",
     ",{{\"index\":{0},\"path\":\"{0}\",\"kind\":\"\",\"name\":\"\",\"parent\":0}}", "]}", ""},
    {"synchronized nodes in each other", kHeadLines + "},\"nodes\":[" + kNode + ",\"delta\":0}",
     ",{{\"index\":{0},\"path\":\"{0}\",\"kind\":\"\",\"name\":\"\",\"parent\":{1},\"delta\":0}}",
     "]}", ""},
    {"nothing but zeros", kHeader, std::string(4, '\0'), "", "not JSON"},
    {"nothing but blanks", kHeader, "    ", "", "not JSON"},
};

// Piece by piece: what this process holds counts as its child's.
void write(const HostileRecording& hostile, const std::string& path) {
  constexpr std::size_t kBytes = kMegabytes * 1'000'000;
  std::ofstream out(path, std::ios::binary);
  out << hostile.begin;
  const bool is_format = contains(hostile.part, "{0");
  std::size_t bytes = 0;
  for (std::size_t number = 1; bytes < kBytes; ++number) {
    const std::string part =
        is_format ? fmt::format(fmt::runtime(hostile.part), number, number - 1) : hostile.part;
    out << part;
    bytes += part.size();
  }
  out << hostile.end << '\n';
}

}  // namespace

TEST_CASE("a hostile line of a recording is refused or read, in a few times its length") {
  const TemporaryDirectory directory;
  const std::string file = directory.path("run.jsonl");
  const std::vector<std::string> commands[] = {
      {"log", "info"}, {"log", "measure"}, {"log", "csv"}, {"log", "diff"}, {"replay", "--print"}};
  for (const HostileRecording& hostile : kRecordings) {
    write(hostile, file);
    for (auto command : commands) {
      command.push_back(file);
      const double readers = command[1] == "diff" ? 2 : 1;
      if (readers == 2) command.push_back(file);
      if (command[1] == "csv") command.insert(command.end(), {"--out", "/dev/null"});
      const Outcome outcome = run_lockstep(command);
      INFO(hostile.name << ", " << command[1] << ": " << outcome.err);
      if (std::getenv("LOCKSTEP_TELL_COST") != nullptr) {
        WARN(fmt::format("{}, {}: {:.2f} s, {:.0f} MB", hostile.name, command[1],
                         outcome.cpu_seconds, outcome.peak_megabytes));
      }
      CHECK(outcome.cpu_seconds < kMaxReadSeconds * readers);
      CHECK(outcome.peak_megabytes < kAlways + kMaxTimes * kMegabytes * readers);
      CHECK(outcome.err.size() < 1000);
      CHECK(outcome.code < 128);
      if (hostile.error.empty()) continue;
      CHECK(outcome.code == 3);
      CHECK(contains(outcome.err, hostile.error));
    }
  }
}

}  // namespace lockstep::host::test
