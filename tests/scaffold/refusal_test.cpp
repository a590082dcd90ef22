// `lockstep new` refuses in a sentence, writes over nothing, and leaves nothing half made.
#include <catch2/catch.hpp>
#include <filesystem>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct Refusal {
  std::string arguments;
  std::string message;
};

void check_refused(const Refusal& row, const TemporaryDirectory& directory) {
  const Outcome outcome = shell("lockstep new " + row.arguments, directory);
  INFO(row.arguments << '\n' << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, row.message));
  CHECK(contains(outcome.err, "hint: "));
}

std::size_t count_files(const TemporaryDirectory& directory) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory.path("")))
    count += entry.is_regular_file();
  return count;
}

}  // namespace

TEST_CASE("names that are illegal or taken are refused, and nothing is made") {
  const TemporaryDirectory directory;
  for (const Refusal& row :
       {Refusal{"project 'my robot'", "'my robot' cannot be the name of a project"},
        {"project 2robot", "'2robot' cannot be the name of a project"},
        {"project test", "a project cannot be called 'test'"},
        {"plugin motion", "there is a plugin 'motion' already"},
        {"plugin gr/ip", "'gr/ip' cannot be the name of a plugin"},
        {"plugin arm --leaf Wait", "'Wait' is a node of lockstep"},
        {"plugin arm --leaf wave", "'wave' begins with a lowercase letter"},
        {"plugin arm --lang cobol", "cobol"},
        {"tree ''", "'' cannot be the name of a tree"},
        {"leaf Open", "there is not the source of a plugin"},
        {"leaf Open --in nowhere", "there is no 'nowhere'"}}) {
    check_refused(row, directory);
  }
  CHECK(count_files(directory) == 0);
}

TEST_CASE("a leaf that cannot be is refused, and the source stays as it was") {
  const TemporaryDirectory directory;
  REQUIRE(shell("lockstep new plugin arm --leaf Reach", directory).code == 0);
  const std::string source = read_file(directory.path("arm/arm.cpp"));
  for (const Refusal& row :
       {Refusal{"leaf Reach", "'arm/arm.cpp' has a 'Reach' already"},
        {"leaf Sequence", "'Sequence' is a node of lockstep"},
        {"leaf EOF", "'EOF' is written as macros of C are, and may be one"},
        {"leaf NULL", "call it 'Null'"},
        {"leaf M_PIf", "call it 'MPif'"},
        {"leaf L_tmpnam", "'L_tmpnam' is written as macros of C are"},
        {"leaf I", "a name with small letters"},
        {"leaf PortsType", "a node cannot be called 'PortsType'"},
        {"leaf None", "a node cannot be called 'None'"},
        {"leaf Self", "a node cannot be called 'Self'"},
        {"leaf Lockstep", "a node cannot be called 'Lockstep'"},
        {"leaf Sleep", "'Sleep' is a node of lockstep"},
        {"leaf open-door", "'open-door' cannot be the name of a node"},
        {"leaf Action", "a node cannot be called 'Action'"},
        {"leaf Open --port goal", "'goal' is not a port"},
        {"leaf Open --port goal:sting", "'sting' is not a type of a port"},
        {"leaf Open --port x:float", "did you mean 'double'?"},
        {"leaf Open --port name:string", "no port can be called 'name'"},
        {"leaf Open --port _x:int", "'_x' cannot be the name of a port"},
        {"leaf Open --port x:int=1.5", "the default '1.5' of port 'x' is no int"},
        {"leaf Open --port out:x:int=1", "the output 'x' cannot have a default"},
        {"leaf Open --port out:x:number", "the output 'x' cannot be a number"},
        {"leaf Open --port x:int --port x:bool", "two ports are called 'x'"},
        {"leaf Open --doc $'a\\nb'", "more than one line"},
        {"leaf Open --in arm/README.md", "'arm/README.md' is not the source of a plugin"}}) {
    check_refused(row, directory);
  }
  CHECK(read_file(directory.path("arm/arm.cpp")) == source);
}

TEST_CASE("a language says what it does not have") {
  const TemporaryDirectory directory;
  REQUIRE(shell("lockstep new plugin grip --lang python", directory).code == 0);
  check_refused({"node TryAll --kind control", "a plugin in Python has no control nodes"},
                directory);
  check_refused({"leaf Grasp --kind threaded", "a plugin in Python has no threaded actions"},
                directory);
  check_refused({"leaf Open --port x:number", "a plugin in Python has no ports of type"},
                directory);
  for (const std::string name :
       {"pause",  "describe", "more_ports", "behavior", "float", "None", "True",
        "and",    "as",       "assert",     "async",    "await", "del",  "elif",
        "except", "finally",  "global",     "nonlocal", "not",   "or",   "raise",
        "return", "try",      "while",      "with",     "yield"}) {
    check_refused(
        {"leaf Open --port " + name + ":bool", "a port in Python cannot be called '" + name + "'"},
        directory);
  }
}

TEST_CASE("a file that is there is not written over, and none is made beside it") {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory.path("robot/trees"));
  directory.file("robot/trees/robot.xml", "mine");
  const Outcome outcome = shell("lockstep new project robot", directory);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "'robot/trees/robot.xml' is there already"));
  CHECK(count_files(directory) == 1);
  CHECK(read_file(directory.path("robot/trees/robot.xml")) == "mine");
}

TEST_CASE(
    "a project may be made in a folder that is there, and a folder that cannot be written is "
    "named") {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory.path("robot/.git"));
  CHECK(shell("cd robot && lockstep new project .", directory).code == 0);
  CHECK(std::filesystem::exists(directory.path("robot/trees/robot.xml")));
  CHECK(contains(shell("lockstep new project 'a b/arm/'", directory).err, "cd 'a b/arm'\n"));
  CHECK(std::filesystem::exists(directory.path("a b/arm/trees/arm.xml")));
  CHECK(shell("lockstep new tree patrol.xml", directory).out == "patrol.xml\npatrol.test.xml\n");
  directory.file("file", "");
  const Outcome outcome = shell("lockstep new project file/robot", directory);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "cannot make the folder 'file/robot'"));
}

TEST_CASE("after a file that cannot be written, none of the others is there") {
  const TemporaryDirectory directory;
  const Outcome outcome = shell("ulimit -f 1; lockstep new project robot", directory);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "cannot write 'robot/"));
  CHECK(count_files(directory) == 0);
  REQUIRE(shell("lockstep new plugin arm", directory).code == 0);
  const std::string source = read_file(directory.path("arm/arm.cpp"));
  const Outcome leaf = shell("ulimit -f 1; lockstep new leaf Open", directory);
  CHECK(leaf.code == 2);
  CHECK(read_file(directory.path("arm/arm.cpp")) == source);
  CHECK(count_files(directory) == 6);
}

TEST_CASE("a dry run lists the files that would be made, and makes none") {
  const TemporaryDirectory directory;
  const Outcome dry = shell("lockstep new project robot --dry-run", directory);
  CHECK(dry.code == 0);
  CHECK(count_files(directory) == 0);
  const Outcome made = shell("lockstep new project robot", directory);
  CHECK(made.out == dry.out);
  CHECK(lines(made.out).size() == count_files(directory));
  const std::string source = read_file(directory.path("robot/plugins/robot/robot.cpp"));
  CHECK(shell("cd robot && lockstep new leaf Open --dry-run", directory).out ==
        "plugins/robot/robot.cpp\n");
  CHECK(contains(shell("cd robot && lockstep new leaf Open --print", directory).out,
                 "class Open : public"));
  CHECK(read_file(directory.path("robot/plugins/robot/robot.cpp")) == source);
}

TEST_CASE("a source keeps its permissions when a leaf is inserted, and a link stays one") {
  const TemporaryDirectory directory;
  const Outcome outcome = shell(
      "lockstep new plugin grip --lang python && ln -s grip/grip.py link.py && "
      "lockstep new leaf Open --in link.py && test -L link.py && test -x grip/grip.py && "
      "grep -q 'class Open' grip/grip.py && ls grip",
      directory);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK_FALSE(contains(outcome.out, ".new"));
}
