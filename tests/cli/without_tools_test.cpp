// The program that only runs trees, as LOCKSTEP_TOOLS=OFF builds it.
#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr const char* kDoor = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";

Outcome without_tools(std::vector<std::string> arguments) {
  return run({.arguments = std::move(arguments),
              .environment = {{"LOCKSTEP_PLUGIN_PATH", LOCKSTEP_BINARY_DIR "/plugins"}},
              .program = LOCKSTEP_BINARY_DIR "/tests/without_tools"});
}

}  // namespace

TEST_CASE("a program without tools runs and checks trees as the whole one does") {
  const std::vector<std::string> arguments{"run", kDoor, "--clock", "virtual", "--view", "plain"};
  const auto outcome = without_tools(arguments), whole = run_lockstep(arguments);
  CHECK(outcome.code == 0);
  CHECK(outcome.out + outcome.err == whole.out + whole.err);
  CHECK(without_tools({"check", kDoor}).code == 0);
}

TEST_CASE("a program without tools says what it leaves out, and how to get it") {
  const std::vector<std::string> calls[] = {{"show", kDoor},
                                            {"nodes"},
                                            {"schema"},
                                            {"fmt", kDoor},
                                            {"convert", kDoor, "--to", "btcpp"},
                                            {"lsp"},
                                            {"mcp"},
                                            {"completion", "bash"},
                                            {"manual", "pages"},
                                            {"plugin", "check"},
                                            {"log", "info", "x"},
                                            {"replay", "--speed", "2"},
                                            {"study"}};
  for (const auto& call : calls) {
    const auto outcome = without_tools(call);
    INFO(call[0] << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("this lockstep was built without '" + call[0] + "'") !=
          std::string::npos);
    CHECK(outcome.err.find("./dev build") != std::string::npos);
  }
  const auto groot = without_tools({"run", kDoor, "--groot2"});
  CHECK(groot.code == 2);
  CHECK(groot.err.find("--groot2: this lockstep was built without it\n  hint: ./dev build") !=
        std::string::npos);
  CHECK(without_tools({"--help"}).out.find("Not in this build") != std::string::npos);
  CHECK(without_tools({"stduy"}).err.find("did you mean 'study'?") != std::string::npos);
}
