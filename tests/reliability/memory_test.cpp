// A program without memory: every command ends with a message and a code, wherever it runs out.
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
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

void check_end(const Outcome& outcome) {
  CAPTURE(outcome.err);
  // 5: a leaf, which has no memory either. 4: a plugin.
  CHECK((outcome.code == 0 || outcome.code == 9 || outcome.code == 5 || outcome.code == 4));
  if (outcome.code == 9) CHECK(contains(outcome.err, "lockstep: error: out of memory"));
}

}  // namespace

TEST_CASE("out of memory, every command says so and has a code for it") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml", tree_text("<ParallelAbsolute barriers=\"{plan}\"><Advance step=\"0.01\"/>"
                            "<Wait seconds=\"1\"/></ParallelAbsolute>"));
  const std::string file = directory.path("run.jsonl");
  const std::string plan = "plan=0.5;1";
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", file, "--set", plan}).code ==
          0);
  const std::vector<Strings> commands = {
      {"check", tree},
      {"check", tree, "--format", "github"},
      {"show", tree},
      {"nodes"},
      {"schema"},
      {"run", tree, "--set", plan, "--clock", "virtual", "--record", directory.path("again.jsonl")},
      {"run", tree, "--set", plan, "--clock", "virtual", "--view", "live"},
      {"run", tree, "--set", plan, "--clock", "virtual", "--json"},
      {"study", tree, "--set", plan, "--runs", "60", "--jobs", "2", "--no-plots", "--out",
       directory.path("s")},
      {"log", "info", file},
      {"log", "csv", file},
      {"log", "measure", file},
      {"log", "measure", file, "--json"},
      {"log", "diff", file, file},
      {"replay", file, "--print"}};
  constexpr long kLast = 30;  // each of them: what is done in the end is the command itself
  for (const Strings& command : commands) {
    const auto succeeds = [&](long from) {
      CAPTURE(command, from);
      run({.arguments = {"-rf", directory.path("s")}, .program = "/bin/rm"});
      const Outcome outcome = without_memory(command, from);
      check_end(outcome);
      return outcome.code == 0;
    };
    long fails = 0, enough = 1;
    while (!succeeds(enough)) {
      fails = enough;
      enough += enough / 2 + 1;
      REQUIRE(enough < 100'000'000);
    }
    while (enough - fails > 1) {
      const long middle = fails + (enough - fails) / 2;
      (succeeds(middle) ? enough : fails) = middle;
    }
    for (long from = std::max(1L, enough - kLast); from < enough; ++from) succeeds(from);
  }
}

}  // namespace lockstep::host::test
