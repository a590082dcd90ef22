// `lockstep plugin check` of shared objects.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

Outcome check_plugin(const std::string& file, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"plugin", "check", file};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_lockstep(arguments);
}

}  // namespace

TEST_CASE("plugin check: the plugins that ship keep the contract, control nodes included") {
  for (const std::string name : {"motion", "nav", "fetch", "r1sim"}) {
    const Outcome outcome = check_plugin(LOCKSTEP_BINARY_DIR "/plugins/" + name + ".so");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "/" + name + ".so: ok\n"));
    CHECK(!contains(outcome.out, "wrong"));
  }
}

TEST_CASE("plugin check: a plugin is found by its name, and asked all that a run may ask") {
  const Outcome outcome = check_plugin("motion", {"--plugin-path", LOCKSTEP_BINARY_DIR "/plugins"});
  CHECK(outcome.code == 0);
  for (const std::string line :
       {"ok    has 'Advance', 'Profile'",
        "ok    'Advance' answers 20 ticks; it is running, progress ",
        "ok    'Advance' is halted while it is held\n", "ok    'Advance' runs beside another one\n",
        " sets of values of its ports", "ok    is deinitialized\n"}) {
    INFO(line << "\n" << outcome.out);
    CHECK(contains(outcome.out, line));
  }
}

TEST_CASE("plugin check: what breaks the contract is named, with its leaf") {
  const std::pair<const char*, const char*> cases[] = {
      {"status_out_of_range", "wrong 'Probe' returned status "},
      {"nan_progress", "wrong 'Probe' reported a progress that is not a number\n"},
      {"two_progresses", "wrong 'Probe' keeps another progress (LOCKSTEP_KEPT_PROGRESS) than"},
      {"condition_running", "wrong 'Probe' is a condition and returned running\n"},
      {"throws_exception", "wrong 'Probe' threw an exception"},
      {"wrong_abi", "ABI"},
      {"describes_another",
       "wrong 'Shape' with kind=\"1\": plugin 'shapes' is malformed: what it describes for "
       "'Shape' "},
      {"init_refuses", "wrong "}};
  for (const auto& [name, message] : cases) {
    const Outcome outcome = check_plugin(abi_plugin(name));
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.out, message));
    CHECK(contains(outcome.out, ".so: does not keep the contract (docs/plugins.md)\n"));
  }
  const Outcome good = check_plugin(abi_plugin("error_in_tick"));  // an error is an answer
  CHECK(good.code == 0);
  CHECK(contains(good.out, "ok    'Probe' answers tick 1 with an error: "));
}

TEST_CASE("plugin check: a leaf that ends its process is named, and the others are examined") {
  const Outcome outcome = check_plugin(LOCKSTEP_BINARY_DIR "/tests/cli/edgy.so");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.out, "ok    'Divides' goes on after it was held\n"));
  CHECK(
      contains(outcome.out,
               "wrong 'Divides' with parts=0: its process ended with exit code 6; the report is on "
               "stderr\n"));
  CHECK(contains(outcome.err, "(Divides of plugin 'edgy') crashed in tick 0: SIGABRT"));
  CHECK(contains(outcome.out,
                 "wrong 'Ends' is halted while it is held: its process ended with exit code 6"));
  CHECK(contains(outcome.err, "(Ends of plugin 'edgy') called exit()"));
  CHECK(contains(outcome.out, "wrong 'Percent' reported the progress 37"));
  CHECK(contains(outcome.out, "ok    'Sound' runs beside another one\n"));
  CHECK(!contains(outcome.out, "wrong 'Sound'"));
  const Outcome hung =
      check_plugin(LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so", {"--hang-limit", "0.2"});
  INFO(hung.out << hung.err);
  CHECK(hung.code == 4);
  CHECK(contains(hung.out, ": its process ended with exit code 6"));
}

TEST_CASE("plugin check: what is no plugin, and an option for programs") {
  CHECK(contains(check_plugin("/nowhere/x.so").err, "'/nowhere/x.so' is no plugin"));
  CHECK(check_plugin("/nowhere/x.so").code == 2);
  const TemporaryDirectory directory;
  const Outcome text = check_plugin(directory.file("x.so", "no ELF"));
  CHECK(text.code == 4);
  CHECK(contains(text.out, "wrong "));
  const Outcome save = check_plugin(LOCKSTEP_BINARY_DIR "/plugins/motion.so", {"--save"});
  CHECK(save.code == 2);
  CHECK(contains(save.err, "--save is for programs"));
}

TEST_CASE("plugin check: elements whose ports depend on a choice are tried with each choice") {
  const Outcome object = check_plugin(abi_plugin("shapes_sdk"));
  INFO(object.out << object.err);
  CHECK(object.code == 0);
  CHECK(contains(object.out, "ok    'Box' with kind=\"round\" answers 1 tick; it is success\n"));
  CHECK(contains(object.out, "ok    'Box' with kind=\"square\" answers 1 tick; it is success\n"));
  CHECK(
      contains(object.out,
               "ok    'Shape' is not examined: no element has kind=\"1\": there is no such shape"));
  const Outcome program = check_plugin(LOCKSTEP_SOURCE_DIR "/tests/programs/shapes_class.py");
  INFO(program.out << program.err);
  CHECK(program.code == 0);
  CHECK(contains(program.out, "ok    'Box' with kind=\"square\" has 4 ports\n"));
  CHECK(contains(program.out,
                 "ok    'Shape' with kind=\"1\" is not tried: there is no such shape\n"));
  CHECK(contains(program.out, "'Box 2' answers "));
  CHECK(!contains(program.out, "error"));
  const Outcome hostile = check_plugin(LOCKSTEP_SOURCE_DIR "/tests/programs/hulls.py");
  CHECK(hostile.code == 4);
  CHECK(contains(hostile.out,
                 "wrong 'Hull' with kind=\"1\" count=\"1\" is not tried: 'Hull' cannot"));
}

TEST_CASE(
    "plugin check --save --tree writes what elements have, for commands that run no program") {
  const TemporaryDirectory directory;
  const std::string program =
      directory.file("shapes.py", read_file(LOCKSTEP_SOURCE_DIR "/tests/programs/shapes_class.py"));
  chmod(program.c_str(), 0755);
  const auto tree = [&](const std::string& nodes) {
    return directory.file("tree.xml",
                          "<root lockstep=\"1\"><plugin name=\"shapes\" program=\"shapes.py\"/>"
                          "<BehaviorTree ID=\"T\"><Sequence>" +
                              nodes + "</Sequence></BehaviorTree></root>");
  };
  const std::string shape = R"(<Shape kind="round" size.radius="1"/>)";
  const Outcome saved = check_plugin(program, {"--save", "--tree", tree(shape)});
  INFO(saved.out << saved.err);
  CHECK(saved.code == 0);
  const auto check = [&](const std::string& nodes) {
    return run_lockstep({"check", tree(nodes), "--plugin-path", directory.path("")});
  };
  CHECK(check(shape).code == 0);
  const Outcome wrong = check(R"(<Shape kind="round" size.radios="1" size.radius="1"/>)");
  CHECK(wrong.code == 3);
  CHECK(contains(wrong.err, "did you mean 'size.radius'?"));
  const Outcome unknown = check(R"(<Shape kind="square" size.side="1"/>)");
  CHECK(unknown.code == 3);
  CHECK(contains(unknown.err, "--save --tree TREE"));
  const Outcome bad = check_plugin(program, {"--save", "--tree", tree(R"(<Shape kind="oval"/>)")});
  CHECK(bad.code == 3);
  CHECK(contains(bad.err, "there is no such shape"));
}
