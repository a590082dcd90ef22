// docs/plugins.md, "Ports that the tree does not bind": the same in each language.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

struct Language {
  std::string name;
  std::string plugin;             // a file
  std::vector<std::string> more;  // options
  bool has_optional = true;
};

const std::string kPlugins = LOCKSTEP_BINARY_DIR "/tests/cli/";
const std::string kPrograms = LOCKSTEP_SOURCE_DIR "/tests/programs/";
const Language kLanguages[] = {
    {"C++", kPlugins + "unbound.so", {}, false},
    {"C++, isolated", kPlugins + "unbound.so", {"--isolate"}, false},
    {"C", kPlugins + "unbound_c.so", {}},
    {"C, isolated", kPlugins + "unbound_c.so", {"--isolate"}},
    {"Python", kPrograms + "unbound.py", {}},
    {"a program", kPrograms + "unbound_raw.py", {}},
};

std::string tree_around(const std::string& attributes) {
  return "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Unbound " + attributes +
         "/></BehaviorTree></root>";
}

// What the leaf says that it reads of a port: before it sets it, after it, and in the next tick.
std::vector<std::string> read_of(const std::string& port, const std::string& output) {
  std::vector<std::string> values;
  for (const std::string& line : lines(output)) {
    const auto at = line.find(": " + port + " ");
    if (at != std::string::npos) values.push_back(line.substr(at + port.size() + 3));
  }
  return values;
}

Outcome run_leaf(const Language& language, const std::string& attributes) {
  const TemporaryDirectory directory;
  std::vector<std::string> arguments{"run",      directory.file("t.xml", tree_around(attributes)),
                                     "--plugin", language.plugin,
                                     "--clock",  "virtual",
                                     "--view",   "none"};
  arguments.insert(arguments.end(), language.more.begin(), language.more.end());
  return run_lockstep(arguments);
}

// The same file as a module, in a program that ticks the tree.
Outcome run_module(const std::string& attributes) {
  const std::string script =
      "import sys, lockstep\n"
      "import unbound\n"
      "say = lambda path, level, text: print(f'{path}: {text}', file=sys.stderr)\n"
      "print(lockstep.Tree(text='" +
      tree_around(attributes) + "', leaves=unbound, log=say).run().result)\n";
  return run(
      {.arguments = {"-c", script},
       .environment = {{"PYTHONPATH", LOCKSTEP_SOURCE_DIR "/plugins/sdk/python:" + kPrograms},
                       {"PYTHONDONTWRITEBYTECODE", "1"},
                       {"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"},
                       {"LD_PRELOAD", LOCKSTEP_PRELOAD},
                       {"ASAN_OPTIONS", "detect_leaks=0"}},
       .program = "/usr/bin/python3"});
}

using Strings = std::vector<std::string>;

void check(const Outcome& outcome, bool is_bound, bool has_optional) {
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "success"));
  CHECK(read_of("both", outcome.err) ==
        (is_bound ? Strings{"0.25", "2", "2"} : Strings{"0.25", "0.25", "0.25"}));
  if (!has_optional) return;
  CHECK(read_of("maybe", outcome.err) ==
        (is_bound ? Strings{"none", "3", "3"} : Strings{"none", "none", "none"}));
}

}  // namespace

TEST_CASE("an output that its entry does not take is a fault, in the same process and isolated") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", R"(<root BTCPP_format="4"><BehaviorTree ID="T">
<Sequence><Script code="z := 1"/><Switch2 variable="{z}" case_1="0" case_2="1"><AlwaysSuccess/>
<AlwaysSuccess/><AlwaysSuccess/></Switch2><Unbound both="{z}"/></Sequence></BehaviorTree></root>)");
  for (const bool isolated : {false, true}) {
    std::vector<std::string> arguments{"run",     tree,      "--plugin", kLanguages[0].plugin,
                                       "--clock", "virtual", "--view",   "none"};
    if (isolated) arguments.push_back("--isolate");
    const Outcome it = run_lockstep(arguments);
    INFO(it.err);
    CHECK(it.code != 0);
    CHECK(contains(it.err,
                   "cannot set 'both': the entry '{z}' has the type string, the port the type "
                   "double"));
  }
  // And so it is for leaves that are played, and in a proof.
  const std::string model =
      directory.file("m.leaves.xml",
                     "<leaves lockstep=\"1\"><leaf of=\"Unbound\" ticks=\"1\" "
                     "result=\"success\" writes=\"success\" out.both=\"0.5\"/></leaves>");
  const Outcome proof = shell(
      "lockstep verify t.xml --leaves m.leaves.xml --plugin " + kLanguages[0].plugin, directory);
  INFO(proof.out << proof.err);
  CHECK(contains(proof.out, "fault/T/Sequence/Unbound"));
  CHECK(contains(proof.out, "sets an output that its entry does not take"));
  const std::string played = directory.file("t.leaves", "T/Sequence/Unbound = S[both=0.5]\n");
  const Outcome run = run_lockstep({"run", tree, "--plugin", kLanguages[0].plugin, "--clock",
                                    "virtual", "--view", "none", "--leaves", played});
  INFO(run.err);
  CHECK(run.code == 5);
  CHECK(contains(run.err, "port 'both': the entry '{z}' has the type string"));
}

TEST_CASE("what a leaf sets where the tree binds no entry is discarded, in each language") {
  for (const Language& language : kLanguages) {
    INFO(language.name);
    check(run_leaf(language, ""), false, language.has_optional);
    check(run_leaf(language, "out=\"{o}\" both=\"{b}\"" +
                                 std::string(language.has_optional ? " maybe=\"{m}\"" : "")),
          true, language.has_optional);
  }
  check(run_module(""), false, true);
  check(run_module("out=\"{o}\" both=\"{b}\" maybe=\"{m}\""), true, true);
}

TEST_CASE("an output or inout is bound to an entry, or left out") {
  for (const Language& language : kLanguages) {
    const Outcome outcome = run_leaf(language, "both=\"3\"");
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "the inout 'both' needs a blackboard entry"));
  }
}
