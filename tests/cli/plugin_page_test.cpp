// The first five minutes of docs/plugins.md, word for word, by a stranger with an empty directory.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// The page's blocks of this kind, in their order.
std::vector<std::string> blocks(const std::string& page, const std::string& kind) {
  const std::string open = "\n```" + kind + "\n";
  std::vector<std::string> found;
  for (auto at = page.find(open); at != std::string::npos; at = page.find(open, at)) {
    at += open.size();
    found.push_back(page.substr(at, page.find("```\n", at) - at));
  }
  return found;
}

}  // namespace

TEST_CASE("docs/plugins.md: what it says works word for word, from the installation to a run") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/plugins.md");
  const auto commands = blocks(page, "sh");
  REQUIRE(commands.size() == 2);
  const std::string kBuild = "./dev build\n";  // what it makes is there
  REQUIRE(commands[0].starts_with(kBuild));

  const TemporaryDirectory home;
  const std::string script =
      "cd ~\nmkdir -p sources/build\nln -s '" LOCKSTEP_BINARY_DIR
      "' sources/build/release\n"
      "cd sources\n" +
      commands[0].substr(kBuild.size()) + "cd ..\n" + commands[1] +
      "cd ..\nlockstep run lockstep/share/lockstep/trees/door_pulling.xml --clock virtual\n"
      "lockstep run lockstep/share/lockstep/trees/commands.xml\n";
  const Outcome outcome = run({.arguments = {"-e", "-c", script},
                               .environment = {{"HOME", home.path("")}},
                               .program = "/bin/sh"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("MoveArm (") != std::string::npos);
  CHECK(outcome.out.find("100% tests passed, 0 tests failed out of 3") != std::string::npos);
  CHECK(outcome.err.find("Main/both/right: success") != std::string::npos);
  CHECK(read_file(home.path("arm/CMakeLists.txt")) == blocks(page, "cmake").at(0));
  CHECK(read_file(home.path("arm/arm.cpp")) == blocks(page, "cpp").at(0));
  CHECK(read_file(home.path("arm/tree.xml")) == blocks(page, "xml").at(0));
  CHECK((outcome.out + outcome.err).find("Main/Sequence/both/fast: success") != std::string::npos);
  for (const char* file :
       {"LICENSE", "README.md", "docs/language.md", "schema/lockstep.xsd",
        "python/lockstep_leaf.py", "python/lockstep/__init__.py", "schema/program.schema.json"}) {
    INFO(file);
    CHECK(std::filesystem::exists(home.path("lockstep/share/lockstep/") + file));
  }
}
