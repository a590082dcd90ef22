// The files of `lockstep new` build without a warning, run, and pass their tests: in each language.
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kConfigure = "cmake -B build -Dlockstep_DIR='" LOCKSTEP_BINARY_DIR
                               "/cmake/lockstep' -DCMAKE_C_FLAGS='-Wall -Wextra -Werror' "
                               "-DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror' "
                               "--no-warn-unused-cli >log 2>&1 && cmake --build build >>log 2>&1 "
                               "&& ctest --test-dir build >>log 2>&1";

bool has_rust() {
  return std::filesystem::exists("/usr/bin/rustc");
}

// Each line of the script is to succeed.
std::string succeed(const std::string& script, const TemporaryDirectory& directory) {
  const Outcome outcome = shell("set -e\n" + script, directory);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  return outcome.out;
}

void make_project(const std::string& language, const TemporaryDirectory& directory) {
  succeed("lockstep new project robot --lang " + language + "\ncd robot\n" + kConfigure +
              " || { cat log; exit 1; }\n"
              "lockstep run trees/robot.xml --plugin-path build --clock virtual\n"
              "lockstep check --strict trees/*.xml --plugin-path build\n"
              "lockstep test --plugin-path build\n"
              // As colcon does; the plugin is found without --plugin-path then.
              "cmake --install build --prefix ../installed >>log\n"
              "AMENT_PREFIX_PATH=$PWD/../installed lockstep run trees/robot.xml --clock virtual\n",
          directory);
  const std::string log = read_file(directory.path("robot/log"));
  CHECK(contains(log, "100% tests passed, 0 tests failed out of 3"));
  CHECK_FALSE(contains(log, "arning"));
}

const std::string kPorts =
    " --port goal:string --port speed:double=0.5 --port out:angle:double --port inout:tries:int=0 "
    "--port is_open:bool=true --port 'way:list of double=1;2'";
const std::string kListPorts = " --port 'b:list of int' --port 'c:list of string=x;y\\;\"z'";

// Words of C++, and names that leaves have there.
const std::string kWordsOfCpp =
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t "
    "class compl const const_cast constexpr continue decltype default delete do double "
    "dynamic_cast else enum explicit export extern false float for friend goto if inline int long "
    "mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public "
    "register reinterpret_cast return short signed sizeof static static_assert static_cast struct "
    "switch template this thread_local throw true try typedef typeid typename union unsigned using "
    "virtual void volatile wchar_t while xor xor_eq";
const std::string kMembersOfCpp =
    "progress tick start halt pause resume check log now random uniform wake context required run "
    "begin finish tick_period tick_number random_bits host_extension Status kWakes kRealTime "
    "kKeepsProgress kDuration more_ports describe behavior Input Output InOut Fixed optional "
    "between at_least at_most PortsType kMinChildren kMaxChildren child_count tick_child "
    "halt_child child_status child_progress set_progress keeps_progress kept_progress host "
    "AwkwardPorts GraspPorts TryAllPorts TwicePorts Awkward linux unix NULL NAN EOF errno std "
    "lockstep Action Ports Leaf start_port";

std::string ports_of(const std::string& names) {
  std::istringstream words(names);
  std::string ports, name;
  while (words >> name) ports += " --port " + name + ":double=1";
  return ports;
}

// What a person does with a node that is printed: its definition goes in front of the line with the
// list of nodes, its last line into that list.
struct Paste {
  std::string line, list;
};

// What `lockstep new` makes of these arguments goes into the source of the plugin, which keeps the
// contract.
void add_nodes(const std::vector<std::string>& nodes, const std::string& plugin,
               const TemporaryDirectory& directory, const Paste& paste = {}) {
  std::string script = "cd robot\n";
  for (const std::string& node : nodes) {
    script += "lockstep new " + node + " > made\n";
    if (paste.line.empty()) continue;
    script +=
        "python3 - '" + paste.line + "' '" + paste.list +
        "' plugins/robot/robot.* <<'E'\nimport sys\nline, list, path = sys.argv[1:]\n"
        "text, made = open(path).read(), open('made').read().rstrip()\n"
        "definition, entry = made.rsplit('\\n\\n', 1)\n"
        "at = text.index(line)\ninto = text.index(list, at) + len(list)\n"
        "end = '' if entry.endswith(';') else ', '\n"
        "open(path, 'w').write(text[:at] + definition + '\\n\\n' + text[at:into] + entry + end + "
        "text[into:])\nE\n";
  }
  script += "touch plugins/robot/CMakeLists.txt\n" + kConfigure +
            " || { cat log; exit 1; }\nlockstep plugin check " + plugin;
  const std::string out = succeed(script, directory);
  CHECK(contains(out, plugin + ": ok"));
  for (const std::string& node : nodes) {
    std::istringstream words(node);
    std::string what, id;
    words >> what >> id;
    INFO(out);
    CHECK(contains(out, "'" + id + "'"));
  }
}

// The page's first block of this kind, for a lockstep that is where this build is.
std::string commands_of(const std::string& page) {
  const std::string text = read_file(LOCKSTEP_SOURCE_DIR "/" + page);
  const std::string open = "\n```sh\n", first = "lockstep new project";
  const auto begin = text.rfind(open, text.find(first)) + open.size();
  const std::string block = text.substr(begin, text.find("```\n", begin) - begin);
  return "export lockstep_DIR='" LOCKSTEP_BINARY_DIR "/cmake/lockstep'\n" +
         block.substr(block.find(first));
}

}  // namespace

TEST_CASE("what README.md and docs/new.md say of a first project works word for word") {
  for (const char* page : {"README.md", "docs/new.md"}) {
    const TemporaryDirectory directory;
    const std::string out =
        succeed(commands_of(page) + "lockstep new leaf Greet\ncmake --build build\n", directory);
    CHECK(contains(out, "100% tests passed, 0 tests failed out of 3"));
  }
}

TEST_CASE("a project in C++ builds and passes its tests, and nodes of all kinds can be added") {
  const TemporaryDirectory directory;
  make_project("c++", directory);
  add_nodes(
      {"leaf OpenDoor" + kPorts,
       "leaf Lists" + kListPorts + " --port 'd:list of bool' --port e:number=1",
       "leaf Awkward --port elapsed_:int=1" + ports_of(kWordsOfCpp) + ports_of(kMembersOfCpp),
       "leaf IsOpen --kind condition --doc 'Whether the \"door\" is open' --port limit:double",
       "leaf Grasp --kind threaded --port force:double" + ports_of(kMembersOfCpp), "leaf Plain",
       "node TryAll --kind control --port times:int=3" + ports_of(kMembersOfCpp),
       "node Twice --kind decorator" + ports_of(kMembersOfCpp)},
      "build/robot.so", directory);
}

TEST_CASE("a project in C builds and passes its tests, and nodes can be added") {
  const TemporaryDirectory directory;
  make_project("c", directory);
  add_nodes(
      {"leaf OpenDoor" + kPorts,
       "leaf Lists" + kListPorts + " --port 'd:list of bool' --port e:number=1",
       "leaf Awkward --port progress:double=1 --port create:string --port ports:int=1",
       "leaf IsOpen --kind condition --doc 'Whether */ the \"door\" is open' --port limit:double",
       "leaf Plain", "node TryAll --kind control", "node Twice --kind decorator",
       // In small letters they are words of C, or functions of its library.
       "leaf Int", "leaf Enum --port x:int", "leaf Exit --kind condition"},
      "build/robot.so", directory, {"static const lockstep_leaf_type* const", "= {"});
}

TEST_CASE("a project in Python passes its tests, and leaves can be added") {
  const TemporaryDirectory directory;
  make_project("python", directory);
  add_nodes(
      {"leaf OpenDoor" + kPorts, "leaf Lists" + kListPorts + " --port 'd:list of bool'",
       "leaf IsOpen --kind condition --doc 'Whether the \"door\" is open' --port limit:double",
       "leaf Plain"},
      "build/robot.py", directory);
}

TEST_CASE("a project in Rust builds and passes its tests, and leaves can be added") {
  if (!has_rust()) {
    WARN("there is no rustc: not tested");
    return;
  }
  const TemporaryDirectory directory;
  make_project("rust", directory);
  add_nodes(
      {"leaf OpenDoor" + kPorts,
       "leaf IsOpen --kind condition --doc 'Whether the \"door\" is open' --port limit:double",
       "leaf Plain"},
      "build/robot.so", directory, {"#[no_mangle]", "&["});
}

#ifndef LOCKSTEP_SANITIZED  // what it is linked with would need the sanitizer
TEST_CASE("a project for BehaviorTree.CPP builds and passes its tests, and nodes can be added") {
  const TemporaryDirectory directory;
  make_project("btcpp", directory);
  add_nodes({"leaf OpenDoor" + kPorts, "leaf Lists" + kListPorts,
             "leaf IsOpen --kind condition --port limit:double", "leaf Plain",
             "node TryAll --kind control --port times:int=3", "node Twice --kind decorator"},
            "build/robot.so", directory, {"BT_REGISTER_NODES", "{"});
}
#endif

TEST_CASE("the commands that follow a new tree name the folder of its plugin") {
  const TemporaryDirectory directory;
  succeed(
      "lockstep new plugin grip --lang python\ncd grip\nlockstep new tree more --plugin grip.py "
      "2>&1 | grep -q "
      "'run more.xml --plugin-path \\.$'\nlockstep run more.xml --plugin-path . --clock virtual\n"
      "cd ..\nlockstep new tree other --plugin far.py 2>&1 | grep -q 'plugin-path build'",
      directory);
}

TEST_CASE("a second plugin in a project is built with it, and a leaf goes where --in says") {
  const TemporaryDirectory directory;
  succeed(
      "lockstep new project robot\ncd robot\nlockstep new plugin gripper --lang python --leaf "
      "Grip\n" +
          kConfigure +
          " || { cat log; exit 1; }\n"
          "lockstep run trees/gripper.xml --plugin-path build --clock virtual\n"
          "lockstep new leaf Open --in plugins/gripper\ngrep -q 'class Open' "
          "plugins/gripper/gripper.py",
      directory);
  CHECK(contains(read_file(directory.path("robot/log")),
                 "100% tests passed, 0 tests failed out of 6"));
  const Outcome either = shell("cd robot && lockstep new leaf Shut", directory);
  CHECK(either.code == 2);
  CHECK(contains(either.err, "there are 2 plugins here"));
  CHECK(contains(either.err, "'--in plugins/gripper/gripper.py', '--in plugins/robot/robot.cpp'"));
  // What is installed below the project does not count.
  succeed(
      "cd robot\nrm plugins/robot/robot.cpp\nfor lib in lib lib64 lib/x86_64-linux-gnu share; do\n"
      "mkdir -p installed/$lib/lockstep/plugins\n"
      "cp plugins/gripper/gripper.py installed/$lib/lockstep/plugins\ndone\n"
      "lockstep new leaf Shut",
      directory);
}

TEST_CASE("a plugin alone builds, and one in Python needs no build") {
  const TemporaryDirectory directory;
  succeed("lockstep new plugin left-arm\ncd left-arm\n" + kConfigure +
              " || { cat log; exit 1; }\nlockstep run tree.xml --plugin-path build --clock virtual",
          directory);
  CHECK(contains(read_file(directory.path("left-arm/log")), "100% tests passed"));
  succeed(
      "lockstep new plugin grip --lang python\ncd grip\nlockstep test --plugin-path .\n"
      "lockstep run tree.xml --plugin-path . --clock virtual",
      directory);
  // The saved leaves are those of the program.
  const std::string made = read_file(directory.path("grip/grip.leaves.json"));
  succeed("cd grip\nlockstep plugin check --save ./grip.py", directory);
  CHECK(read_file(directory.path("grip/grip.leaves.json")) == made);
}

TEST_CASE("a new tree runs and passes its scenarios, in both languages") {
  const TemporaryDirectory directory;
  succeed(
      "lockstep new tree patrol\nlockstep new tree dock --language btcpp4\nlockstep test\n"
      "for tree in patrol dock; do lockstep run $tree.xml --clock virtual; lockstep check --strict "
      "$tree.xml; done",
      directory);
  succeed(
      "lockstep new tree drive --plugin motion\nlockstep run drive.xml --clock virtual\n"
      "lockstep new tree grip --plugin grip.py\ngrep -q 'name=\"grip\" program=\"grip.py\"' "
      "grip.xml",
      directory);
  CHECK(contains(read_file(directory.path("dock.xml")), "BTCPP_format"));
}
