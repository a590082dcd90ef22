// What a command does when what it says, or what it was asked for, cannot be written: the reader
// has gone, stopped reading, the disk is full, or the descriptor was closed from the start.
#include <sched.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;

// In a directory with tree.xml, bad.xml and run.jsonl.
class Shell {
 public:
  Shell() {
    directory_.file("tree.xml", tree_text("<Sequence><Advance step=\"0.1\"/></Sequence>"));
    directory_.file("slow.xml", tree_text("<Advance step=\"0.1\"/>"));
    directory_.file("bad.xml", tree_text("<Unknown/>"));
    CHECK(call("lockstep run tree.xml --clock virtual --record run.jsonl").code == 0);
  }
  Outcome call(const std::string& script) const {
    return run({.arguments = {"-c", "cd \"$0\" && PATH=\"$1:$PATH\" && " + script, path(""),
                              LOCKSTEP_BINARY_DIR},
                .program = "/bin/bash"});
  }
  std::string path(const std::string& name) const { return directory_.path(name); }

 private:
  TemporaryDirectory directory_;
};

// One line for each command that writes results.
const std::vector<std::string> kWritingCommands = {
    "check tree.xml",
    "check --format json tree.xml",
    "show tree.xml",
    "nodes",
    "schema",
    "run tree.xml --clock virtual --view none",
    "study tree.xml --runs 1 --measure duration --no-plots --out s",
    "study tree.xml --runs 1 --measure duration --no-plots --out j --json",
    "log info run.jsonl",
    "log csv run.jsonl",
    "log measure run.jsonl",
    "replay run.jsonl --print",
    "--help",
    "run --help",
    "--version"};

}  // namespace

TEST_CASE("results that a full disk does not take are an error of every command") {
  const Shell shell;
  for (const std::string& command : kWritingCommands) {
    INFO(command);
    const Outcome outcome = shell.call("lockstep " + command + " >/dev/full");
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "cannot write to stdout: No space left on device"));
    CHECK_FALSE(contains(outcome.err, "cut"));
  }
}

TEST_CASE("results that nobody wants to read end every command quietly, as SIGPIPE would") {
  const Shell shell;
  const DeadEnd gone(DeadEnd::Reader::Gone);
  for (const std::string& command : kWritingCommands) {
    INFO(command);
    const Outcome both = shell.call("lockstep " + command + " >&" + gone.number() + " 2>&1");
    CHECK(both.code == 141);
    const Outcome outcome = shell.call("rm -rf s j; lockstep " + command + " >&" + gone.number());
    CHECK(outcome.code == 141);
    CHECK(outcome.err.empty());
    shell.call("rm -rf s j");
  }
}

TEST_CASE("the result of a run counts more than that its summary could not be written") {
  const Shell shell;
  const Outcome limit =
      shell.call("lockstep run tree.xml --clock virtual --max-ticks 2 --view none >/dev/full");
  CHECK(limit.code == 124);
  CHECK(contains(limit.err, "cannot write to stdout: No space left on device"));
}

TEST_CASE("messages that cannot be written change nothing about what a command does") {
  const Shell shell;
  const DeadEnd gone(DeadEnd::Reader::Gone);
  const std::vector<std::pair<std::string, int>> rows = {
      {"run tree.xml --view none --tick-budget 0.000001", 0},
      {"run tree.xml --view plain", 0},
      {"run tree.xml --view live", 0},
      {"run tree.xml --clock virtual --max-ticks 1", 124},
      {"run bad.xml", 3},
      {"check bad.xml", 3},
      {"check nowhere.xml", 3},
      {"check --no-such-option", 2},
      {"no-such-command", 2},
      {"log info nowhere.jsonl", 2},
      {"study tree.xml --runs 100 --measure duration --no-plots --out $RANDOM$RANDOM", 0}};
  for (const std::string& to : {std::string("/dev/full"), "&" + gone.number(), std::string("&-")}) {
    for (const auto& [command, code] : rows) {
      INFO(command << " 2>" << to);
      CHECK(shell.call("lockstep " + command + " 2>" + to).code == code);
    }
  }
}

TEST_CASE("a run says how many of its messages could not be written") {
  const Shell shell;
  const Outcome outcome =
      shell.call("lockstep run tree.xml --clock virtual --view plain --json 2>/dev/full");
  CHECK(outcome.code == 0);
  CHECK(parse_json(outcome.out)["notes"] ==
        json::array({"4 lines of stderr are lost: No space left on device"}));
}

TEST_CASE("a closed descriptor does not become a file of ours") {
  const Shell shell;
  const std::string command = "lockstep run tree.xml --clock virtual --record again.jsonl ";
  for (const auto& [closed, code] : std::vector<std::pair<std::string, int>>{
           {">&-", 2}, {"2>&-", 0}, {"<&-", 0}, {"<&- 2>&-", 0}, {"<&- >&- 2>&-", 2}}) {
    INFO(closed);
    CHECK(shell.call(command + closed).code == code);
    CHECK(read_file(shell.path("again.jsonl")) == read_file(shell.path("run.jsonl")));
    CHECK(shell
              .call("lockstep study tree.xml --runs 20 --measure duration --no-plots --out s " +
                    closed)
              .code == code);
    const auto rows = lines(read_file(shell.path("s/runs.csv")));
    CHECK(rows.size() == 21);
    shell.call("rm -r s");
  }
  CHECK(contains(shell.call("lockstep nodes >&-").err, "cannot write to stdout"));
}

TEST_CASE("a reader who stops reading stderr holds nothing up") {
  const Shell shell;
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  const std::string good = std::string(LOCKSTEP_BINARY_DIR) + "/tests/abi/plugins/good.so";
  shell.call("sed 's/Advance/Probe ticks=\"1000000\"/; s/ step=\"0.1\"//' slow.xml >talks.xml");
  for (const std::string& view : std::vector<std::string>{"none", "plain", "live"}) {
    INFO(view);
    const Outcome outcome = shell.call("lockstep run talks.xml --plugin " + good +
                                       " --rate 1000 --timeout 0.5 --view " + view +
                                       " --json --record stuck.jsonl 2>&" + stuck.number());
    CHECK(outcome.code == 124);
    const json summary = parse_json(outcome.out);
    CHECK(summary["ticks"] > 100);
    CHECK(contains(summary["notes"].dump(), "of stderr are lost: no process read them"));
    CHECK(contains(lines(read_file(shell.path("stuck.jsonl"))).back(), "\"reason\":\"timeout\""));
  }
}

TEST_CASE("a signal ends the wait for a reader of stdout, also when it comes before the wait") {
  const TemporaryDirectory directory;
  const DeadEnd stuck(DeadEnd::Reader::Stuck);
  const std::string tree = directory.file("tree.xml", tree_text("<AlwaysRunning/>"));
  for (int round = 0; round < 20; ++round) {
    const std::string record = directory.path(std::to_string(round));
    Process process({.arguments = {"-c", "exec " LOCKSTEP_BINARY_DIR "/lockstep run " + tree +
                                             " --max-ticks 2 --view none --record " + record +
                                             " >&" + stuck.number()},
                     .program = "/bin/sh"});
    while (!std::filesystem::exists(record) || !contains(read_file(record), "max_ticks")) {
      sched_yield();
    }
    process.signal(SIGINT);
    CHECK(process.finish().code == 124);
  }
}

// What is only written when all is known: the table of a compressed file, all of a short MCAP, the
// images that gnuplot draws, which ends well on a full disk.
TEST_CASE("a disk that is full at the very end is an error of what was to be written") {
  const Shell shell;
  const std::string run = "lockstep run tree.xml --clock virtual --view none --record ";
  REQUIRE(shell.call(run + "whole.jsonl.zst").code == 0);
  const std::string carry = "'" LOCKSTEP_SOURCE_DIR "/trees/carry_together/carry.xml'";
  struct Row {
    std::string limit, command, path;
    int code;
  };
  for (const Row& it : std::vector<Row>{
           {"$(($(stat -c %s whole.jsonl.zst) - 10))", run + "cut.jsonl.zst", "cut.jsonl.zst", 0},
           {"1000", run + "cut.mcap --on-record-error stop", "cut.mcap", 8},
           {"5000", "lockstep team " + carry + ",me=left " + carry + ",me=right --record team",
            "team/left.jsonl", 8},
           {"15000", "lockstep study tree.xml --runs 2 --measure duration --out s", "s/plots/",
            2}}) {
    INFO(it.command);
    const Outcome outcome = shell.call("prlimit --fsize=" + it.limit + " " + it.command);
    CHECK(outcome.code == it.code);
    CHECK(contains(outcome.err, "error: cannot write '" + it.path));
  }
}

}  // namespace lockstep::host::test
