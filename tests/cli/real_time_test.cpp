// Leaves that work in real time, on a clock where no tick waits for them: a warning names them.
#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kPlugin = LOCKSTEP_BINARY_DIR "/tests/abi/plugins/real_time.so";

struct Tree {
  TemporaryDirectory directory;
  std::string file = directory.file(
      "tree.xml", tree_text("<Sequence memory=\"true\"><Probe name=\"plan\"/><Wait seconds=\"0\"/>"
                            "<Probe name=\"grasp\"/></Sequence>"));
  const std::string warning =
      file +
      ": warning: on the virtual clock no tick waits for leaves that work in real time: "
      "'Main/Sequence/plan' (Probe of plugin 'real_time'), "
      "'Main/Sequence/grasp' (Probe of plugin 'real_time') [real-time-leaf]\n  hint: ";

  Outcome run(const std::string& clock) const {
    return run_lockstep({"run", file, "--plugin", kPlugin, "--clock", clock});
  }
};

}  // namespace

TEST_CASE("a run on the virtual clock warns of leaves that work in real time") {
  const Tree tree;
  const Outcome outcome = tree.run("virtual");
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, tree.warning + "the run means little; use --clock wall\n"));
  CHECK_FALSE(contains(tree.run("wall").err, "warning"));
}

TEST_CASE("a study warns once of leaves that work in real time") {
  const Tree tree;
  const Outcome outcome = run_lockstep({"study", tree.file, "--runs", "2", "--measure", "duration",
                                        "--grid", "rate=50,100", "--plugin", kPlugin, "--no-plots",
                                        "--out", tree.directory.path("out")});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  const auto first = outcome.err.find(tree.warning);
  CHECK(first != std::string::npos);
  CHECK(outcome.err.find("warning", first + tree.warning.size()) == std::string::npos);
}

TEST_CASE("of many leaves that work in real time a warning names five") {
  const TemporaryDirectory directory;
  std::string leaves;
  for (int i = 0; i < 8; ++i) leaves += "<Probe/>";
  const std::string file =
      directory.file("tree.xml", tree_text("<Parallel>" + leaves + "</Parallel>"));
  const Outcome outcome =
      run_lockstep({"run", file, "--plugin", kPlugin, "--clock", "virtual", "--view", "none"});
  CHECK(contains(outcome.err, "'Main/Parallel/Probe#5' (Probe of plugin 'real_time') and 3 more"));
  CHECK_FALSE(contains(outcome.err, "Probe#6' (Probe"));
}

TEST_CASE("nodes says which leaves work in real time") {
  const auto listed = [](const std::string& format) {
    return run_lockstep({"nodes", "Probe", "--plugin", kPlugin, "--format", format}).out;
  };
  CHECK(contains(listed("text"),
                 "It works in real time: on the virtual clock no tick waits for it."));
  CHECK(contains(listed("markdown"), "it works in real time"));
  CHECK(parse_json(listed("json"))[0]["real_time"] == true);
}
