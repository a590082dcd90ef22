// What the README shows is what happens: its action is compiled, its tree is run with it.
#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// The text of the README's first block of this kind.
std::string block(const std::string& readme, const std::string& kind) {
  const std::string open = "```" + kind + "\n";
  const auto begin = readme.find(open) + open.size();
  return readme.substr(begin, readme.find("```\n", begin) - begin);
}

}  // namespace

TEST_CASE("the README's action compiles and its tree runs as shown") {
  const std::string readme = read_file(LOCKSTEP_SOURCE_DIR "/README.md");
  const TemporaryDirectory directory;
  const std::string source = directory.file("reach.cpp", block(readme, "cpp"));
  const std::string tree = directory.file("lift.xml", block(readme, "xml"));
  const Outcome compiled =
      run({.arguments = {"-std=c++17", "-shared", "-fPIC", "-I" LOCKSTEP_SOURCE_DIR "/plugins/sdk",
                         source, "-o", directory.path("arm.so")},
           .program = LOCKSTEP_CXX});
  INFO(compiled.err);
  REQUIRE(compiled.code == 0);

  const Outcome outcome =
      run_lockstep({"run", tree, "--plugin-path", directory.path(""), "--clock", "virtual"});
  CHECK(outcome.code == 0);
  std::string shown = block(readme, "console");
  for (int command = 0; command < 2; ++command) shown.erase(0, shown.find('\n') + 1);
  CHECK(outcome.err + outcome.out == shown);
}
