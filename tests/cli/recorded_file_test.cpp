// What of a run is in the file that it leaves, and who may read it.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "cli/program.h"
#include "support/paths.h"

namespace lockstep::test {

TEST_CASE("a recording has the permissions that the umask leaves") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/></BehaviorTree></root>");
  for (const auto& [umask, mode] : {std::pair("077", mode_t{0600}), {"027", 0640}, {"000", 0666}}) {
    const std::string file = directory.path(umask);
    const Outcome outcome =
        run({.arguments = {"-c", "umask $0 && exec \"$@\"", umask, LOCKSTEP_BINARY_DIR "/lockstep",
                           "run", tree, "--clock", "virtual", "--record", file},
             .program = "/bin/sh"});
    CHECK(outcome.code == 0);
    struct stat status {};
    REQUIRE(stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == mode);
  }
}

TEST_CASE("a recording holds arguments, and no value of the blackboard") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"motion\"/><arg name=\"told\" default=\"x\"/>"
      "<BehaviorTree ID=\"Main\"><Advance step=\"{step}\"/></BehaviorTree></root>");
  const std::string file = directory.path("run.jsonl");
  const Outcome outcome = lockstep({"run", tree, "--arg", "told=argument", "--set", "step=0.7317",
                                    "--clock", "virtual", "--max-ticks", "1", "--record", file});
  INFO(outcome.err);
  CHECK(outcome.code == 124);
  CHECK(contains(read_file(file), "\"told\":\"argument\""));
  CHECK_FALSE(contains(read_file(file), "7317"));
}

}  // namespace lockstep::test
