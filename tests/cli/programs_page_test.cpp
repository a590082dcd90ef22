// The first five minutes of docs/programs.md, word for word; and what holds of every leaf that is a
// program.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "support/paths.h"

using namespace lockstep::test;

namespace {

const std::string kProgramsFolder = LOCKSTEP_SOURCE_DIR "/tests/programs";

// The page's first block of this kind.
std::string first_block(const std::string& page, const std::string& kind) {
  const std::string open = "\n```" + kind + "\n";
  const auto begin = page.find(open) + open.size();
  return page.substr(begin, page.find("```\n", begin) - begin);
}

std::string advancing(const std::string& plugin) {
  return "<root lockstep=\"1\"><plugin name=\"motion\"" + plugin +
         "/><BehaviorTree ID=\"Main\"><Sequence memory=\"true\"><ParallelAbsolute "
         "barriers=\"0.3;0.6\"><Advance name=\"arm\" step=\"0.04\"/><Advance name=\"base\" "
         "step=\"0.1\"/></ParallelAbsolute><Advance step=\"0.3\"/></Sequence></BehaviorTree>"
         "</root>";
}

}  // namespace

TEST_CASE("docs/programs.md: what it says works word for word") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/programs.md");
  const TemporaryDirectory home;
  chmod(home.file("sweep.py", first_block(page, "python")).c_str(), 0755);
  home.file("tree.xml", first_block(page, "xml"));
  const std::string script = "cd '" + home.path("") + "'\n" + first_block(page, "sh");
  const Outcome outcome = run({.arguments = {"-e", "-c", script},
                               .environment = {{"PATH", LOCKSTEP_BINARY_DIR ":/usr/bin:/bin"}},
                               .program = "/bin/sh"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "Sweep: waits for Advance at barrier 0.5"));
}

TEST_CASE("a leaf that is a program gives the recording of the same leaf in C++") {
  const TemporaryDirectory directory;
  std::string recordings[2];
  for (int i = 0; i < 2; ++i) {
    const std::string tree =
        directory.file("tree.xml", advancing(i == 0 ? "" : " program=\"advance.py\""));
    const std::string file = directory.path("run.jsonl");
    const Outcome outcome = lockstep::test::lockstep(
        {"run", tree, "--plugin-path", kProgramsFolder, "--clock", "virtual", "--record", file});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    recordings[i] = read_file(file);
  }
  CHECK(recordings[0].size() > 1000);
  CHECK(recordings[0] == recordings[1]);
}

TEST_CASE("nodes has the leaves and ports of a program") {
  const Outcome outcome = lockstep::test::lockstep(
      {"nodes", "Advance", "--run-programs", "--plugin", kProgramsFolder + "/advance.py"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "step"));
  CHECK(contains(outcome.out, "0.01"));
}
