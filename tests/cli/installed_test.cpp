// What a user has without the sources: documents, example trees, and the plugins of a project.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <sstream>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

namespace fs = std::filesystem;

Outcome run_in(const std::string& directory, const std::string& program,
               std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"-C", directory, program});
  return run({.arguments = std::move(arguments), .program = "/usr/bin/env"});
}

}  // namespace

TEST_CASE("docs lists the pages and prints the path of one, by any of its names") {
  const Outcome list = run_lockstep({"docs"});
  CHECK(list.code == 0);
  CHECK(contains(list.out, "  tutorial "));
  for (const char* name : {"tutorial", "tutorial.md", "docs/tutorial.md"}) {
    const Outcome page = run_lockstep({"docs", name});
    CHECK(page.code == 0);
    REQUIRE(page.out.ends_with("docs/tutorial.md\n"));
    CHECK(fs::exists(page.out.substr(0, page.out.size() - 1)));
  }
  const Outcome wrong = run_lockstep({"docs", "tutorail"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "there is no page 'tutorail'\n  hint: did you mean 'tutorial'?"));
}

TEST_CASE("docs explains the code that ends a message") {
  const TemporaryDirectory directory;
  const Outcome checked = run_lockstep({"check", directory.file("t.xml", tree_text("<Sequnce/>"))});
  CHECK(contains(checked.err, "error: unknown node 'Sequnce' [unknown-node]\n"));
  const Outcome told = run_lockstep({"docs", "unknown-node"});
  CHECK(told.code == 0);
  CHECK(told.out.starts_with("unknown-node\n\nNo built-in node"));
  CHECK(contains(told.out, "\n\nWhat to do: "));
}

TEST_CASE("an example takes the place of a tree file") {
  CHECK(contains(run_lockstep({"examples"}).out, "\n  door_pulling "));
  const Outcome run =
      run_lockstep({"run", "--example", "door_pulling", "--clock", "virtual", "--view", "none"});
  CHECK(run.code == 0);
  CHECK(run.out.starts_with("success after "));
  CHECK(run_lockstep({"show", "--example=paper/example6"}).code == 0);
  struct Row {
    std::vector<std::string> arguments;
    std::string message;
  };
  const Row rows[] = {
      {{"run", "--example", "dor_pulling"}, "'dor_pulling' is not an example; did you mean"},
      {{"run", "--example", "../trees/cart"}, "'../trees/cart' is not an example"},
      {{"run", "--example", "cart", "tree.xml"}, "tree excludes --example"},
      {{"run"}, "tree is required"},
      {{"study"}, "TREE.xml is required"},
  };
  for (const Row& row : rows) {
    const Outcome outcome = run_lockstep(row.arguments);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, row.message));
  }
}

TEST_CASE("help names no file that an installation does not have") {
  const Outcome all = run_lockstep({"--help"});
  const std::regex file("(docs/[a-z_-]+\\.md|trees/[a-z_/]+\\.xml)");
  const std::regex command("\n  ([a-z]+) +[A-Z]");
  for (std::sregex_iterator it(all.out.begin(), all.out.end(), command), end; it != end; ++it) {
    const std::string text = run_lockstep({"help", (*it)[1]}).out;
    std::smatch named;
    INFO((*it)[1]);
    CHECK_FALSE(std::regex_search(text, named, file));
    INFO((named.empty() ? "" : named.str()));
  }
  CHECK_FALSE(std::regex_search(all.out, file));
}

TEST_CASE("help shows no syntax of the library that parses the command line") {
  const Outcome all = run_lockstep({"--help"});
  const std::regex syntax("^ +-.*(\\{[a-z]|TEXT:|:INT|Needs:|Excludes:|REQUIRED|[A-Z]=[0-9a-z])");
  for (const char* command : {"run", "check", "verify", "test", "study", "plugin check", "log plot",
                              "log export", "log events", "convert"}) {
    std::istringstream words(command);
    std::vector<std::string> arguments{"help"};
    for (std::string word; words >> word;) arguments.push_back(word);
    if (std::string_view(command) == "run") arguments = {"run", "--help-all"};
    for (const std::string& line : lines(run_lockstep(arguments).out)) {
      INFO(command << ": " << line);
      CHECK_FALSE(std::regex_search(line, syntax));
    }
  }
  CHECK(contains(run_lockstep({"help", "run"}).out, "(default: 100)"));
}

TEST_CASE("a plugin that is found nowhere else is that of the project, which a note names") {
  const TemporaryDirectory directory;
  const std::string program = directory.path("bin/lockstep");
  fs::create_directories(directory.path("bin"));
  fs::create_directories(directory.path("robot/build"));
  fs::copy_file(LOCKSTEP_BINARY_DIR "/lockstep", program);
  const std::string tree = directory.file("robot/tree.xml", tree_text("<Advance/>"));
  const std::string robot = directory.path("robot");
  const std::vector<std::string> run = {"run", "tree.xml", "--clock", "virtual", "--view", "none"};
  CHECK(run_in(robot, program, run).code == 4);

  fs::copy_file(LOCKSTEP_BINARY_DIR "/plugins/motion.so", robot + "/build/motion.so");
  const Outcome found = run_in(robot, program, run);
  CHECK(found.code == 0);
  CHECK(found.err == "lockstep: note: from the directory 'build' here: the plugin 'motion'\n");
  CHECK(run_in(directory.path("bin"), program, {"check", tree}).code == 4);
  for (const auto& [option, value] :
       {std::pair{"--plugin-path", "build"}, std::pair{"--plugin", "build/motion.so"}}) {
    std::vector<std::string> given = run;
    given.insert(given.end(), {option, value});
    CHECK(run_in(robot, program, given).err.empty());
  }
  // One that is installed comes first.
  const Outcome installed = run_in(robot, LOCKSTEP_BINARY_DIR "/lockstep", run);
  CHECK(installed.code == 0);
  CHECK_FALSE(contains(installed.err, "from the directory"));
}
