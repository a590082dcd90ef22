// Compressed recordings, from outside: the same text in far fewer bytes, read by all commands.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

constexpr const char* kCompressedRecordingTree = LOCKSTEP_SOURCE_DIR "/trees/fetch_and_carry.xml";

std::string record(const TemporaryDirectory& directory, const std::string& name,
                   std::vector<std::string> more = {}) {
  const std::string file = directory.path(name);
  more.insert(more.begin(),
              {"run", kCompressedRecordingTree, "--clock", "virtual", "--record", file});
  REQUIRE(run_lockstep(more).code == 0);
  return file;
}

}  // namespace

TEST_CASE("a compressed recording is at least six times smaller, and says the same") {
  const TemporaryDirectory directory;
  const std::string plain = record(directory, "run.jsonl");
  const std::string named = record(directory, "run.jsonl.zst");
  const std::string asked = record(directory, "other.jsonl", {"--record-compress"});
  CHECK(read_file(named).size() * 6 < read_file(plain).size());
  CHECK(run_lockstep({"log", "diff", plain, named}).code == 0);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"log", "info"},
                                                  {"log", "csv"},
                                                  {"log", "measure"},
                                                  {"replay", "--print", "--at", "1500"}}) {
    INFO(command[0] << ' ' << command[1]);
    const auto output_for = [&](const std::string& file) {
      auto arguments = command;
      arguments.push_back(file);
      const Outcome outcome = run_lockstep(arguments);
      CHECK(outcome.code == 0);
      return outcome.out;
    };
    CHECK(output_for(named) == output_for(plain));
    CHECK(output_for(asked) == output_for(plain));
  }
}

// Where blocks end depends on when the writing thread had time. So the text that can be read says
// which line must be named, wherever that text ends.
TEST_CASE("a compressed recording that is cut is read to its last whole line") {
  const TemporaryDirectory directory;
  const std::string plain = read_file(record(directory, "run.jsonl"));
  const std::string whole = read_file(record(directory, "run.jsonl.zst"));
  constexpr std::size_t kParts = 8;
  std::size_t before = plain.size() / 2 / kParts;
  for (std::size_t part = 2; part < kParts; ++part) {
    const std::string bytes = whole.substr(0, whole.size() * part / kParts);
    const std::string cut = directory.file("cut.zst", bytes);
    const std::string text = run_lockstep({"log", "cat", cut}).out;  // its whole lines
    INFO(part << " of " << kParts << " parts, " << text.size() << " bytes of text");
    CHECK(text.size() >= before);
    before = text.size();
    CHECK(plain.starts_with(text));
    REQUIRE(text.ends_with("\n"));
    const auto number = [](auto line) { return std::to_string(line); };
    const auto count = std::ranges::count(text, '\n');
    const Outcome outcome = run_lockstep({"log", "csv", cut});
    CHECK(outcome.code == 0);
    // The end of a line that is whole otherwise may be what is missing.
    CHECK((contains(outcome.err, "is cut: line " + number(count + 1) + " is cut, ") ||
           contains(outcome.err, "is cut: it ends after line " + number(count) + " without ") ||
           contains(outcome.err, "is cut: it ends after line " + number(count + 1) + " without ")));
    const auto rows = lines(outcome.out);
    // Line 1 is the header, line 2 tick 0.
    const auto tick = std::stoll(rows.back());
    CHECK((tick == count - 2 || tick == count - 1));
  }
}

TEST_CASE("a compressed recording that is damaged is refused, with line and byte") {
  const TemporaryDirectory directory;
  const std::string bytes = read_file(record(directory, "run.jsonl.zst"));
  const std::string bad = directory.file("bad.zst", bytes + "not a frame");
  const Outcome outcome = run_lockstep({"log", "csv", bad});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "bad.zst:"));
  CHECK(contains(outcome.err, "its compressed bytes "));
}

TEST_CASE("a small file that would give a huge text is refused, and costs little") {
  const std::string bomb = LOCKSTEP_SOURCE_DIR "/tests/fuzz/corpus/fuzz_compressed/bomb.zst";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"log", "info", bomb}, {"log", "cat", bomb}}) {
    const Outcome outcome = run_lockstep(command);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "bomb.zst:"));
    CHECK(contains(outcome.err, "it has more than 256 times as much text as bytes"));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    CHECK(outcome.peak_megabytes < 80);
#endif
  }
}

TEST_CASE("log cat prints the text, and --follow ends with the run") {
  const TemporaryDirectory directory;
  const std::string plain = record(directory, "run.jsonl");
  const std::string packed = record(directory, "run.jsonl.zst");
  for (const std::string& file : {plain, packed}) {
    for (const std::vector<std::string>& options : {std::vector<std::string>(), {"--follow"}}) {
      auto command = options;
      command.insert(command.begin(), {"log", "cat", file});
      const Outcome outcome = run_lockstep(command);
      CHECK(outcome.code == 0);
      CHECK(outcome.err == "");
      CHECK(outcome.out == read_file(plain));
    }
  }
  // A run on the robot's clock, which is followed from its first line.
  const std::string live = directory.path("live.jsonl.zst");
  const Outcome outcome = run({.arguments = {"-c",
                                             "\"$0\" run \"$1\" --record \"$2\" >/dev/null 2>&1 & "
                                             "until [ -e \"$2\" ]; do :; done; "
                                             "\"$0\" log cat -f \"$2\" | tail -n 1",
                                             LOCKSTEP_BINARY_DIR "/lockstep",
                                             LOCKSTEP_SOURCE_DIR "/trees/nested.xml", live},
                               .program = "/bin/sh"});
  CHECK(outcome.out.starts_with("{\"end\":{\"result\":\"success\""));
}

TEST_CASE("log cat prints recordings only") {
  const TemporaryDirectory directory;
  for (const std::string text : {"", "{}\n", "{\"lockstep_recording\":1", "no JSON\n"}) {
    const Outcome outcome = run_lockstep({"log", "cat", directory.file("other", text)});
    CHECK(outcome.code == 3);
    CHECK(outcome.out == "");
    CHECK(contains(outcome.err, "other:1: no header of a recording"));
  }
}

TEST_CASE("a part that is not there is a mistake") {
  const TemporaryDirectory directory;
  const std::string file = record(directory, "run.jsonl.zst");
  for (const std::string command : {"csv", "events"}) {
    const Outcome behind = run_lockstep({"log", command, file, "--from", "99999999"});
    CHECK(behind.code == 2);
    CHECK(contains(behind.err, "--from 99999999: the recording has ticks 0 to 3182"));
    const Outcome backward = run_lockstep({"log", command, file, "--from", "20", "--to", "10"});
    CHECK(backward.code == 2);
    CHECK(contains(backward.err, "--to: is before --from"));
  }
}

TEST_CASE("run --record-compress without --record is a mistake") {
  const Outcome outcome = run_lockstep({"run", kCompressedRecordingTree, "--record-compress"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "--record-compress requires --record"));
}

TEST_CASE("an MCAP file is not compressed twice, and is not read") {
  const TemporaryDirectory directory;
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{directory.path("run.mcap.zst")},
        {directory.path("run.mcap"), "--record-compress"}}) {
    auto command = options;
    command.insert(command.begin(),
                   {"run", kCompressedRecordingTree, "--clock", "virtual", "--record"});
    const Outcome outcome = run_lockstep(command);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "--record: an MCAP file is compressed inside"));
  }
  const Outcome outcome = run_lockstep({"log", "info", record(directory, "run.mcap")});
  CHECK(outcome.code == 3);
  CHECK(
      contains(outcome.err, "run.mcap:1: it is an MCAP file, which lockstep writes and does not"));
}

TEST_CASE("log csv --from --to is the part of the table, also where the rest is damaged") {
  const TemporaryDirectory directory;
  const std::string plain = record(directory, "run.jsonl");
  const std::string packed = record(directory, "run.jsonl.zst");
  const Outcome all = run_lockstep({"log", "csv", plain});
  std::string expected;
  std::istringstream rows(all.out);
  for (std::string row; std::getline(rows, row);) {
    const bool is_title = row.starts_with("tick");
    if (is_title || (std::stoi(row) >= 1000 && std::stoi(row) <= 1002)) expected += row + "\n";
  }
  const std::string damaged = directory.file(
      "damaged.jsonl", read_file(plain).insert(read_file(plain).size() - 100, "{damage}\n"));
  for (const std::string& file : {plain, packed, damaged}) {
    const Outcome part = run_lockstep({"log", "csv", file, "--from", "1000", "--to", "1002"});
    CHECK(part.code == 0);
    CHECK(part.err == "");
    CHECK(part.out == expected);
  }
}

}  // namespace lockstep::host::test
