// Recordings in parts, from outside: each opens alone, and all of them are the recording.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

constexpr const char* kTree = LOCKSTEP_SOURCE_DIR "/trees/fetch_and_carry.xml";

std::string record(const TemporaryDirectory& directory, const std::string& name,
                   std::vector<std::string> more = {}) {
  const std::string file = directory.path(name);
  more.insert(more.begin(), {"run", kTree, "--clock", "virtual", "--record", file});
  const Outcome outcome = run_lockstep(more);
  INFO(outcome.err);
  REQUIRE(outcome.code == 0);
  return file;
}

std::vector<std::string> files_in(const TemporaryDirectory& directory) {
  std::vector<std::string> names;
  for (const auto& it : std::filesystem::directory_iterator(directory.path(""))) {
    names.push_back(it.path().filename());
  }
  std::ranges::sort(names);
  return names;
}

std::string output_of(std::vector<std::string> command, const std::string& file) {
  command.push_back(file);
  const Outcome outcome = run_lockstep(command);
  CHECK(outcome.err == "");
  CHECK(outcome.code == 0);
  return outcome.out;
}

const std::vector<std::vector<std::string>> kCommands{
    {"log", "info"},
    {"log", "csv"},
    {"log", "events"},
    {"log", "measure"},
    {"log", "csv", "--from", "1000", "--to", "1010"},
    {"log", "csv", "--from", "3182"},
    {"replay", "--print", "--at", "1500"}};

}  // namespace

TEST_CASE("two runs do not record parts of one name at once, and one after the other they do") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysRunning/>"));
  const std::string name = directory.path("run.jsonl");
  Process first(
      {.arguments = {"run", tree, "--view", "none", "--record", name, "--record-rotate", "1kB"}});
  while (!std::filesystem::exists(directory.path("run.0002.jsonl"))) usleep(1000);
  const Outcome second = run_lockstep({"run", tree, "--clock", "virtual", "--max-ticks", "5",
                                       "--record", name, "--record-rotate", "1MB"});
  CHECK(second.code == 2);
  CHECK(contains(second.err, "another run records to its parts"));
  CHECK(first.end_by(SIGTERM).code == 128 + SIGTERM);
  CHECK(run_lockstep({"log", "csv", name}).err == "");
  CHECK(!std::filesystem::exists(name + ".lock"));
  directory.file("run.jsonl.lock", "");  // of a run that was killed
  CHECK(run_lockstep({"run", tree, "--clock", "virtual", "--max-ticks", "5", "--record", name,
                      "--record-rotate", "1MB"})
            .code == 124);
  CHECK(files_in(directory) == std::vector<std::string>{"run.0001.jsonl", "tree.xml"});
}

TEST_CASE("a run that records parts does not replace a recording that is being written") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysRunning/>"));
  const std::string name = directory.path("run.jsonl");
  Process first({.arguments = {"run", tree, "--view", "none", "--record", name}});
  while (!std::filesystem::exists(name) || std::filesystem::file_size(name) == 0) usleep(1000);
  const Outcome second = run_lockstep({"run", tree, "--clock", "virtual", "--max-ticks", "5",
                                       "--record", name, "--record-rotate", "1MB"});
  CHECK(second.code == 2);
  CHECK(contains(second.err, "another run records to '" + name + "'"));
  CHECK(first.end_by(SIGTERM).code == 128 + SIGTERM);
  CHECK(files_in(directory) == std::vector<std::string>{"run.jsonl", "tree.xml"});
  CHECK(run_lockstep({"log", "csv", name}).err == "");
}

TEST_CASE("the parts of a recording are the recording, by its name and one behind the other") {
  const TemporaryDirectory directory, parts;
  const std::string one = record(directory, "one.jsonl");
  for (const auto& [name, rule] : {std::pair{"run.jsonl", "150kB"},
                                   {"timed.jsonl", "4s"},
                                   {"run.jsonl.zst", "7s"},
                                   {"small.jsonl.zst", "20KiB"},
                                   {"bare", "0.1min"}}) {
    INFO(name << " " << rule);
    const std::string set = record(parts, name, {"--record-rotate", rule});
    for (const auto& command : kCommands) CHECK(output_of(command, set) == output_of(command, one));
    CHECK(run_lockstep({"log", "diff", one, set}).code == 0);
  }
  CHECK(shell("cat run.00*.jsonl | lockstep log diff " + one +
                  " - && "
                  "cat run.00*.zst | lockstep log diff " +
                  one + " -",
              parts)
            .code == 0);
}

TEST_CASE("each part of a recording is one that opens alone") {
  const TemporaryDirectory directory, parts;
  const auto rows = lines(output_of({"log", "csv"}, record(directory, "one.jsonl")));
  record(parts, "run.jsonl.zst", {"--record-rotate", "10s"});
  const auto files = files_in(parts);
  REQUIRE(files == std::vector<std::string>{"run.0001.jsonl.zst", "run.0002.jsonl.zst",
                                            "run.0003.jsonl.zst", "run.0004.jsonl.zst"});
  std::vector<std::string> all{rows[0]};
  for (const std::string& file : files) {
    const std::string path = parts.path(file);
    const auto some = lines(output_of({"log", "csv"}, path));
    all.insert(all.end(), some.begin() + 1, some.end());
    CHECK(output_of({"log", "info"}, path) != "");
    CHECK(output_of({"log", "cat"}, path) != "");
  }
  CHECK(all == rows);
  const std::string third = parts.path(files[2]);
  CHECK(contains(output_of({"log", "info"}, third), "a part that begins with tick 2000\n"));
  CHECK(
      contains(output_of({"log", "info"}, third), "until 30.000 s; the run continues in the next"));
  // Of what a part does not have.
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"replay", "--print", "--at", "5", third},
        {"log", "csv", "--to", "5", third}}) {
    const Outcome outcome = run_lockstep(command);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "5: this part of the recording begins with tick 2000"));
  }
  const Outcome behind = run_lockstep({"log", "csv", "--from", "3000", third});
  CHECK(behind.code == 2);
  CHECK(contains(behind.err, "--from 3000: the recording has ticks 2000 to 2999"));
}

TEST_CASE("run --record-keep keeps the last parts, and they are read from where they begin") {
  const TemporaryDirectory directory, parts;
  const std::string set =
      record(parts, "run.jsonl", {"--record-rotate", "5s", "--record-keep", "2"});
  CHECK(files_in(parts) == std::vector<std::string>{"run.0006.jsonl", "run.0007.jsonl"});
  const std::string one = record(directory, "one.jsonl");
  CHECK(output_of({"log", "csv"}, set) == output_of({"log", "csv", "--from", "2500"}, one));
  const Outcome rest = run_lockstep({"log", "measure", set, "--measure", "ticks", "--measure",
                                     "progress-distance", "--measure", "progress-distance[0:9]"});
  CHECK(contains(rest.err, "note: the recording begins with tick 2500: "));
  for (const std::string& line : lines(rest.out)) {
    if (contains(line, "[0:9]")) CHECK(line.ends_with(" -"));
  }
  const Outcome whole =
      run_lockstep({"log", "measure", one, "--measure", "progress-distance[0:9]"});
  CHECK(whole.err == "");
  CHECK(!contains(whole.out, " -\n"));
}

TEST_CASE("a recording replaces all of an earlier one with its name, and nothing else") {
  const TemporaryDirectory parts;
  record(parts, "run.jsonl");
  record(parts, "run.jsonl", {"--record-rotate", "5s"});
  CHECK(files_in(parts).size() == 7);
  const std::vector<std::string> others{"run.0001.jsonl.zst", "run.01.jsonl", "run.x001.jsonl",
                                        "runs.0009.jsonl"};
  for (const std::string& it : others) std::ignore = parts.file(it, "mine");
  record(parts, "run.jsonl", {"--record-rotate", "20s"});
  CHECK(files_in(parts) == std::vector<std::string>{"run.0001.jsonl", "run.0001.jsonl.zst",
                                                    "run.0002.jsonl", "run.01.jsonl",
                                                    "run.x001.jsonl", "runs.0009.jsonl"});
  // As does one of a single part.
  record(parts, "run.jsonl", {"--record-rotate", "1h"});
  CHECK(files_in(parts).size() == others.size() + 1);
}

TEST_CASE("a recording of a day, and what is no recording, is no part of another one") {
  const TemporaryDirectory days;
  for (const char* const name : {"run.20261128.jsonl", "run.2026.mcap", "run.20261128.mcap"})
    record(days, name);
  for (const char* const name : {"run.2026.jsonl", "run.2027.mcap"})
    std::ignore = days.file(name, "mine");
  const auto before = files_in(days);
  for (const std::string name : {"run.jsonl", "run.mcap"}) {
    record(days, name, {"--record-rotate", "10s"});
    CHECK(files_in(days).size() > before.size());
    record(days, name, {"--record-rotate", "1h"});
    std::filesystem::remove(days.path(name == "run.jsonl" ? "run.0001.jsonl" : "run.0001.mcap"));
  }
  std::vector<std::string> kept = before;
  std::erase(kept, "run.2026.mcap");  // it is as a part would be
  CHECK(files_in(days) == kept);
  std::filesystem::remove(days.path("run.2026.jsonl"));
  const Outcome none = run_lockstep({"log", "info", days.path("run.jsonl")});
  CHECK(contains(none.err, "cannot read"));
  CHECK(contains(none.err, "No such file"));
}

TEST_CASE("what a crash has left of a last part is replaced by the next recording") {
  for (const std::string left : {"", "{\"lockstep_rec", "{\"lockstep_recording\":1,\"tree\""}) {
    const TemporaryDirectory parts;
    record(parts, "run.jsonl", {"--record-rotate", "5s"});
    const auto all = files_in(parts);
    std::ignore = parts.file(all.back(), left);
    record(parts, "run.jsonl", {"--record-rotate", "20s"});
    CHECK(files_in(parts).size() < all.size());
    CHECK(run_lockstep({"log", "info", parts.path("run.jsonl")}).code == 0);
  }
}

TEST_CASE(
    "a pipe in the place of a part is an error of the recording, and its reader is not waited "
    "for") {
  const TemporaryDirectory parts;
  REQUIRE(mkfifo(parts.path("run.0002.jsonl").c_str(), 0600) == 0);
  const Outcome outcome =
      run_lockstep({"run", kTree, "--clock", "virtual", "--record", parts.path("run.jsonl"),
                    "--record-rotate", "10s", "--on-record-error", "stop"});
  CHECK(outcome.code == 8);
  CHECK(contains(outcome.err, "run.0002.jsonl': it is not a file"));
}

TEST_CASE("on the virtual clock, a run has the same parts each time") {
  const TemporaryDirectory parts;
  for (const std::string name : {"a.jsonl", "b.jsonl"}) {
    record(parts, name, {"--record-rotate", "100kB"});
  }
  const auto files = files_in(parts);
  REQUIRE(files.size() > 10);
  for (std::size_t i = 0; i < files.size() / 2; ++i) {
    CHECK(read_file(parts.path(files[i])) == read_file(parts.path(files[files.size() / 2 + i])));
    CHECK(read_file(parts.path(files[i])).size() < 200'000);
  }
}

TEST_CASE("log scenario takes all parts, and refuses one that is not the first") {
  const TemporaryDirectory directory, parts;
  const std::string one = record(directory, "run.jsonl");
  const std::string set = record(parts, "run.jsonl", {"--record-rotate", "10s"});
  CHECK(output_of({"log", "scenario"}, set) == output_of({"log", "scenario"}, one));
  const Outcome outcome = run_lockstep({"log", "scenario", parts.path("run.0002.jsonl")});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "begins with tick 1000: a scenario needs the begin of the run"));
}

TEST_CASE("a part that is missing or cut is reported, with its place") {
  const TemporaryDirectory parts;
  const std::string set = record(parts, "run.jsonl", {"--record-rotate", "10s"});
  const std::string last = read_file(parts.path("run.0004.jsonl"));
  std::ignore = parts.file("run.0004.jsonl", last.substr(0, last.size() - 200));
  const Outcome cut = run_lockstep({"log", "csv", set});
  CHECK(cut.code == 0);
  CHECK(contains(cut.err, "the recording is cut: line 184 of '" + parts.path("run.0004.jsonl")));
  std::filesystem::remove(parts.path("run.0002.jsonl"));
  const Outcome outcome = run_lockstep({"log", "csv", set});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "cannot read its part '" + parts.path("run.0002.jsonl")));
  std::ignore = parts.file("run.0002.jsonl.zst", "");
  std::ignore = parts.file("run.0002.jsonl", "{\"lockstep_recording\":1}\n");
  CHECK(run_lockstep({"log", "csv", set}).code == 3);
}

TEST_CASE("an error in a recording of several parts names the part and its line, in each command") {
  const TemporaryDirectory parts;
  const std::string set = record(parts, "run.jsonl", {"--record-rotate", "10s"});
  const std::string third = parts.path("run.0003.jsonl");
  std::string text = read_file(third);
  const auto tick = text.find("{\"tick\":2005,");
  REQUIRE(tick != std::string::npos);
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(tick), '\n') + 1;
  std::ignore = parts.file("run.0003.jsonl", text.replace(tick, 13, "{\"tick\":5"));
  const std::string page = parts.path("page.html");
  const std::vector<std::vector<std::string>> commands{
      {"log", "info"},
      {"log", "csv"},
      {"log", "csv", "--from", "2003"},
      {"log", "events"},
      {"log", "measure"},
      {"log", "scenario"},
      {"log", "why"},
      {"log", "check", "--property", "x: never serve.failure"},
      {"log", "diff", set},
      {"log", "page", "--out", page},
      {"log", "page", "--from", "2003", "--out", page},
      {"log", "export", "--format", "mcap", "--out", parts.path("run.mcap")},
      {"replay", "--print", "--at", "2500"}};
  for (std::vector<std::string> command : commands) {
    command.push_back(set);
    const Outcome outcome = run_lockstep(command);
    INFO(command[0] << " " << command[1] << ": " << outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, third + ":" + std::to_string(line) + ": "));
  }
}

TEST_CASE("run --record-rotate: MCAP, and what is refused") {
  const TemporaryDirectory parts;
  record(parts, "run.mcap", {"--record-rotate", "10s"});
  CHECK(files_in(parts).size() == 4);
  for (const std::string rule :
       {"", "5", "5x", "s", "-5s", "0s", "10B", "1e5s", "nanMB", "1e99GB"}) {
    const Outcome outcome =
        run_lockstep({"run", kTree, "--record", parts.path("x"), "--record-rotate", rule});
    INFO(rule);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--record-rotate"));
  }
  CHECK(run_lockstep({"run", kTree, "--record", "x", "--record-keep", "3"}).code == 2);
  const Outcome device =
      run_lockstep({"run", kTree, "--record", "/dev/null", "--record-rotate", "5s"});
  CHECK(device.code == 2);
  CHECK(contains(device.err, "'/dev/null' is not a file"));
}

}  // namespace lockstep::host::test
