// What a command writes is never what it reads, and nothing is lost to a command that did not
// begin.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

const std::string kOutputTree = tree_text("<Advance step=\"0.1\"/>");

// tree.xml, which includes part.xml; links to both; a plugin; a recording.
void fill(const TemporaryDirectory& directory) {
  directory.file("part.xml",
                 "<root lockstep=\"1\"><BehaviorTree ID=\"Part\"><Advance "
                 "step=\"0.1\"/></BehaviorTree></root>");
  directory.file("tree.xml",
                 "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><plugin "
                 "name=\"motion\"/><include path=\"part.xml\"/><BehaviorTree "
                 "ID=\"Main\"><SubTree ID=\"Part\"/></BehaviorTree></root>");
  fs::copy(LOCKSTEP_BINARY_DIR "/plugins/motion.so", directory.path("motion.so"));
  for (const std::string file : {"tree.xml", "part.xml"}) {
    fs::create_symlink(file, directory.path("soft-" + file));
    fs::create_hard_link(directory.path(file), directory.path("hard-" + file));
  }
  REQUIRE(shell("lockstep run tree.xml --clock virtual --record run.jsonl", directory).code == 0);
  fs::create_hard_link(directory.path("run.jsonl"), directory.path("hard.jsonl"));
  fs::create_symlink("run.jsonl", directory.path("run.svg"));
}

// Every file below `directory` and what is in it.
std::map<std::string, std::string> contents(const TemporaryDirectory& directory) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(directory.path(""))) {
    if (entry.is_regular_file()) all[entry.path().string()] = read_file(entry.path().string());
  }
  return all;
}

}  // namespace

TEST_CASE("no output option overwrites an input of its command") {
  const TemporaryDirectory directory;
  fill(directory);
  directory.file("props", "never Main.failure\n");
  directory.file("motion.leaves.json", "{}");
  directory.file("lockstep.project.xml",
                 "<project lockstep=\"1\"><main file=\"tree.xml\"/></project>");
  const auto before = contents(directory);
  const std::string run = "lockstep run tree.xml --clock virtual --record ";
  for (const std::string& command :
       {run + "tree.xml",
        run + "./soft-tree.xml",
        run + "hard-tree.xml",
        run + "part.xml",
        run + "soft-part.xml",
        run + "hard-part.xml",
        std::string("lockstep run tree.xml --plugin ./motion.so --record motion.so"),
        std::string("lockstep run tree.xml --plugin ./motion.so --record motion.leaves.json"),
        std::string("cat tree.xml | lockstep run - --record part.xml"),
        std::string("lockstep run - --record tree.xml <tree.xml"),
        run + "/dev/stdin <tree.xml",
        run + "/dev/stdout | cat",
        run + "/dev/stderr 2>&1 | cat",
        run + "run.jsonl >>run.jsonl",
        std::string("lockstep log csv run.jsonl --out run.jsonl"),
        std::string("lockstep log csv run.jsonl --out hard.jsonl"),
        std::string("lockstep log csv - --out hard.jsonl <run.jsonl"),
        std::string("lockstep log plot run.jsonl --out run.svg"),
        std::string("lockstep log plot - --out run.svg <run.jsonl"),
        run + "lockstep.project.xml",
        run + "props --property-file props",
        std::string("lockstep verify tree.xml --property-file props --ticket props"),
        std::string("lockstep verify tree.xml --ticket lockstep.project.xml"),
        std::string("lockstep log export run.jsonl --format btlog --tree-file tree.xml --out "
                    "hard-tree.xml"),
        std::string("lockstep log export run.jsonl --format btlog --tree-file tree.xml --plugin "
                    "./motion.so --out motion.so")}) {
    INFO(command);
    const Outcome outcome = shell("set -o pipefail; " + command, directory);
    CHECK(outcome.code == 2);
    CHECK((contents(directory) == before));
  }
  const Outcome outcome = shell(run + "hard-tree.xml", directory);
  CHECK(outcome.err ==
        "lockstep: error: --record hard-tree.xml: it is the same file as tree.xml\n"
        "  hint: name another file\n");
}

TEST_CASE("a study does not write over the tree that it runs") {
  const TemporaryDirectory directory;
  fill(directory);
  REQUIRE(shell("lockstep study tree.xml --runs 2 --measure duration --no-plots --out s", directory)
              .code == 0);
  shell("ln -f tree.xml s/summary.csv", directory);
  const Outcome outcome = shell(
      "lockstep study tree.xml --runs 2 --measure duration --no-plots --out s --resume", directory);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "s/summary.csv: it is the same file as tree.xml"));
  CHECK(contains(read_file(directory.path("tree.xml")), "<root"));
}

TEST_CASE("a recording survives a run that does not begin") {
  const TemporaryDirectory directory;
  fill(directory);
  directory.file("bad.xml", tree_text("<Unknown/>"));
  const auto before = contents(directory);
  const std::string plugins = LOCKSTEP_BINARY_DIR "/tests/abi/plugins/";
  for (const auto& [arguments, code] : std::vector<std::pair<std::string, int>>{
           {"tree.xml --cpu 4095", 2},
           {"bad.xml", 3},
           {"nowhere.xml", 3},
           {"tree.xml --plugin " + plugins + "init_refuses.so", 4},
           {"tree.xml --plugin nowhere.so", 4},
           {"tree.xml --no-such-option", 2}}) {
    INFO(arguments);
    CHECK(shell("lockstep run " + arguments + " --record run.jsonl", directory).code == code);
    CHECK((contents(directory) == before));
  }
}

TEST_CASE("a recording replaces the file of its name, and nothing that a link leads to") {
  const TemporaryDirectory directory;
  fill(directory);
  const std::string run = "lockstep run tree.xml --clock virtual --max-ticks 1 --record ";
  const std::string whole = read_file(directory.path("run.jsonl"));
  CHECK(shell(run + "run.jsonl", directory).code == 124);
  CHECK(read_file(directory.path("run.jsonl")).size() < whole.size());
  CHECK(read_file(directory.path("hard.jsonl")) == whole);  // the old file, by its other name
  const Outcome link = shell(run + "run.svg", directory);
  CHECK(link.code == 2);
  CHECK(contains(link.err, "cannot open 'run.svg': it is a symbolic link; name the file itself"));
  CHECK(shell(run + "/dev/null", directory).code == 124);
  CHECK(shell(run + "/dev/null >/dev/null 2>&1 </dev/null", directory).code == 124);
  const Outcome piped =
      shell("mkfifo f; lockstep log info f & " + run + "f >/dev/null; wait $!", directory);
  CHECK(contains(piped.out, "stopped (max_ticks) after 1 tick"));
}

TEST_CASE("a table replaces the file of its name when it is whole") {
  const TemporaryDirectory directory;
  fill(directory);
  directory.file("old.csv", "old");
#if !defined(__SANITIZE_THREAD__)  // whose programs all die of this limit, an empty one too
  CHECK(shell("ulimit -f 0; lockstep log csv run.jsonl --out old.csv", directory).code == 2);
#endif
  CHECK(read_file(directory.path("old.csv")) == "old");
  CHECK(shell("lockstep log csv run.jsonl --out old.csv", directory).code == 0);
  CHECK(read_file(directory.path("old.csv")) ==
        run_lockstep({"log", "csv", directory.path("run.jsonl")}).out);
}

}  // namespace lockstep::host::test
