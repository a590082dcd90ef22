// A program without memory: every command ends with a message and a code, wherever it runs out.
#include <catch2/catch.hpp>

#include "cli/program.h"
#include "support/paths.h"

namespace lockstep::test {
namespace {

using Strings = std::vector<std::string>;

// From the n-th `new` on there is no memory.
Outcome without_memory(const Strings& arguments, long from) {
  return run({.arguments = arguments,
              .environment = {{"LD_PRELOAD", LOCKSTEP_HOSTILE_DIRECTORY "/no_memory.so"},
                              {"NO_MEMORY_AT", std::to_string(from)},
                              {"ASAN_OPTIONS",
                               "verify_asan_link_order=0:detect_leaks=0:"
                               "intercept_tls_get_addr=0"}}});
}

}  // namespace

TEST_CASE("out of memory, every command says so and has a code for it") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<ParallelAbsolute barriers=\"0.5;1\"><Advance step=\"0.01\"/>"
                            "<Wait seconds=\"1\"/></ParallelAbsolute>"));
  const std::string file = directory.path("run.jsonl");
  REQUIRE(lockstep({"run", tree, "--clock", "virtual", "--record", file}).code == 0);
  const std::vector<Strings> commands = {
      {"check", tree},
      {"show", tree},
      {"nodes"},
      {"schema"},
      {"run", tree, "--clock", "virtual", "--record", directory.path("again.jsonl")},
      {"run", tree, "--clock", "virtual", "--view", "live"},
      {"study", tree, "--runs", "60", "--jobs", "2", "--no-plots", "--out", directory.path("s")},
      {"log", "measure", file}};
  for (const Strings& command : commands) {
    bool ended_well = false;
    for (long from = 1; !ended_well; from += from / 2 + 1) {
      CAPTURE(command, from);
      run({.arguments = {"-rf", directory.path("s")}, .program = "/bin/rm"});
      const Outcome outcome = without_memory(command, from);
      CAPTURE(outcome.err);
      ended_well = outcome.code == 0;
      // 5: a leaf, which has no memory either. 4: a plugin.
      CHECK((ended_well || outcome.code == 9 || outcome.code == 5 || outcome.code == 4));
      if (outcome.code == 9) CHECK(contains(outcome.err, "lockstep: error: out of memory"));
      REQUIRE(from < 100'000'000);
    }
  }
}

}  // namespace lockstep::test
