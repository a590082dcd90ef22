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

// A program with one leaf, that always succeeds. `leaf` and its `answer` to describe are
// expressions of Python.
std::string program_that_describes(const TemporaryDirectory& directory, const std::string& leaf,
                                   const std::string& answer) {
  std::string program = directory.file("program.py", R"(#!/usr/bin/python3
import json, os, sys
print(json.dumps(dict(lockstep=1, leaves=[)" + leaf + R"(])), flush=True)
for line in sys.stdin:
    request = json.loads(line)
    if request["do"] == "describe":
        print()" + answer + R"(, flush=True)
    elif request["do"] == "tick":
        print(json.dumps(dict(leaf=request["leaf"], status="success")), flush=True)
    elif request["do"] in ("create", "halt"):
        print(json.dumps(dict(leaf=request["leaf"], done=True)), flush=True)
)");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  return program;
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
        "ok    'Advance' is halted while it is held\n", "ok    'Advance' continues after a cut\n",
        "ok    'Advance' runs alongside another one\n", " sets of values of its ports",
        "ok    is deinitialized\n"}) {
    INFO(line << "\n" << outcome.out);
    CHECK(contains(outcome.out, line));
  }
}

TEST_CASE("plugin check: another object continues where the leaf was when its process was cut") {
  const Outcome outcome = check_plugin(LOCKSTEP_BINARY_DIR "/tests/cli/cut.so");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 4);
  CHECK(contains(
      outcome.out,
      "wrong 'Forget' continues after a cut: cut after 1 tick, it is running at 0.111111 in tick 1 "
      "behind that, and without the cut running at 0.222222\n"));
  CHECK(!contains(outcome.out, "'Step' continues after a cut"));
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
      {"describes_otherwise",
       "wrong 'Shape' with kind=\"round\" has other ports when it is described again: the same "
       "constants give the same ports\n"},
      {"describes_never",
       "wrong 'Shape' has no element: describe refuses each choice and default of its fixed "
       "ports\n"},
      {"init_refuses", "wrong "}};
  for (const auto& [name, message] : cases) {
    const Outcome outcome = check_plugin(abi_plugin(name));
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.out, message));
    CHECK(contains(outcome.out, ".so: does not keep the contract (`lockstep docs plugins`)\n"));
  }
  const Outcome good = check_plugin(abi_plugin("error_in_tick"));  // an error is an answer
  CHECK(good.code == 0);
  CHECK(contains(good.out, "ok    'Probe' answers tick 1 with an error: "));
}

TEST_CASE("plugin check: a leaf that ends its process is named, and the others are examined") {
  const Outcome outcome = check_plugin(LOCKSTEP_BINARY_DIR "/tests/cli/edgy.so");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.out, "ok    'Divides' continues after it was held\n"));
  CHECK(
      contains(outcome.out,
               "wrong 'Divides' with parts=0: its process ended with exit code 6; the report is on "
               "stderr\n"));
  CHECK(contains(outcome.err, "(Divides of plugin 'edgy') crashed in tick 0: SIGABRT"));
  CHECK(contains(outcome.out,
                 "wrong 'Ends' is halted while it is held: its process ended with exit code 6"));
  CHECK(contains(outcome.err, "(Ends of plugin 'edgy') called exit()"));
  CHECK(contains(outcome.out, "wrong 'Percent' reported the progress 37"));
  CHECK(contains(outcome.out, "ok    'Sound' runs alongside another one\n"));
  CHECK(!contains(outcome.out, "wrong 'Sound'"));
  const Outcome hung =
      check_plugin(LOCKSTEP_BINARY_DIR "/tests/cli/stuck.so", {"--hang-limit", "0.2"});
  INFO(hung.out << hung.err);
  CHECK(hung.code == 4);
  CHECK(contains(hung.out, ": its process ended with exit code 6"));
}

TEST_CASE("plugin check gives a fixed port a value of its range") {
  const TemporaryDirectory directory;
  const std::string program =
      program_that_describes(directory, R"({"id": "S", "more_ports": ["x.*"], "ports": [
          {"name": "k", "type": "int", "fixed": True, "min": 2, "max": 9}]})",
                             R"(json.dumps(dict(ports=[
          {"name": "x.%d" % i, "type": "double", "default": 0.0} for i in range(request["fixed"]["k"])])))");
  const Outcome it = run_lockstep({"plugin", "check", program});
  INFO(it.out << it.err);
  CHECK(it.code == 0);
  CHECK(contains(it.out, "ok    'S' with k=\"2\" has 3 ports"));
}

TEST_CASE(
    "plugin check and run: what a program describes wrongly is named, with the leaf and port") {
  const TemporaryDirectory directory;
  const std::string program =
      program_that_describes(directory, R"({"id": "Shape", "more_ports": ["size.*"], "ports": [
          {"name": "kind", "type": "string", "fixed": True, "choices": ["round", "square"]}]})",
                             R"(open(os.path.dirname(sys.argv[0]) + "/answer").read())");
  const std::string tree =
      directory.file("t.xml",
                     "<root lockstep=\"1\"><plugin name=\"shape\" program=\"program.py\"/>\n"
                     "<BehaviorTree ID=\"T\"><Shape kind=\"round\" size.r=\"2\"/>"
                     "</BehaviorTree></root>");
  const std::string wrongly = "answers describe wrongly: ", whose = "what it describes for 'Shape'";
  const std::pair<std::string, std::string> rows[] = {
      {R"({"ports":[{"name":"size.r"}]})", wrongly + "port 'size.r': 'type' is missing"},
      {R"({"ports":[{"name":"size.a","type":"int"},{"name":"size.r","type":"real"}]})",
       wrongly + "port 'size.r': the type of a port is 'real', expected "},
      {R"({"ports":[{"type":"double"}]})", wrongly + "a port: 'name' is missing"},
      {R"({"ports":[7]})", wrongly + "a port: "},
      {R"({"ports":{"name":"size.r"}})", wrongly + "'ports' is not a list"},
      {R"({"ports":null})", wrongly + "'ports' is not a list"},
      {R"({})", wrongly + "expected 'ports' or 'refused'"},
      {R"([])", wrongly + "expected a JSON object"},
      {R"({"leaf":1,"done":true})", wrongly + "expected 'ports' or 'refused'"},
      {R"({"ports":[{"name":"size.r","type":"double"})", wrongly + "not JSON"},
      {"Traceback (most recent call last):", wrongly + "not JSON"},
      {"", wrongly + "not JSON"},
      {R"({"ports":[{"name":"size.r","type":"double","direction":"up"}]})",
       wrongly + "port 'size.r': the direction of a port is 'up'"},
      {R"({"ports":[{"name":"size.r","type":"double","min":"a"}]})",
       wrongly + "port 'size.r': 'min' is not a number"},
      {R"({"ports":[{"name":"size.r","type":"double","default":[1]}]})",
       wrongly + "port 'size.r': a default is not"},
      {R"({"ports":[{"name":"size.r","type":"double","optional":"yes"}]})",
       wrongly + "port 'size.r': a flag is not true or false"},
      {R"({"refused":7})", wrongly + "'refused' is not a string"},
      {R"({"ports":[{"name":"","type":"double"}]})", whose},
      {R"({"ports":[{"name":"size r","type":"double"}]})", "port 1 is named 'size r'"},
      {R"({"ports":[{"name":"size.r","type":"double","min":5,"max":1}]})",
       "port 1 ('size.r') has min 5 and max 1"},
      {R"({"ports":[{"name":"size.r","type":"double","default":"far"}]})",
       "port 1 ('size.r') has the default 'far'"},
      {R"({"ports":[{"name":"size.r","type":"int"},{"name":"size.r","type":"int"}]})",
       "port 2 is named 'size.r', as a port before it"},
      {R"({"ports":[{"name":"kind","type":"string"}]})", "port 1 is named 'kind', as a port"}};
  for (const auto& [answer, message] : rows) {
    directory.file("answer", answer);
    const Outcome checked = check_plugin(program);
    INFO(answer << '\n' << checked.out << checked.err);
    CHECK(checked.code == 4);
    CHECK(contains(checked.out, "wrong 'Shape' with kind=\"round\" "));
    CHECK(contains(checked.out, message));
    CHECK_FALSE(contains(checked.out, "guardian"));
    const Outcome run = run_lockstep(
        {"run", tree, "--plugin-path", directory.path(""), "--clock", "virtual", "--view", "none"});
    INFO(run.err);
    CHECK(run.code == 3);
    CHECK(contains(run.err, "t.xml:2:22: error: "));
    CHECK(contains(run.err, message));
  }
}

TEST_CASE("plugin check: ports that a program may not describe are named") {
  const TemporaryDirectory directory;
  const std::string program = directory.file("area.py", R"(#!/usr/bin/python3
import json, os, sys
print(json.dumps(dict(lockstep=1, leaves=[{"id": "Shape", "more_ports": ["size.*"], "ports": [
    {"name": "kind", "type": "string", "fixed": True, "choices": ["round"]}]}])), flush=True)
for line in sys.stdin:
    request = json.loads(line)
    if request["do"] == "describe":
        answers = open(os.path.dirname(sys.argv[0]) + "/answers").read().splitlines()
        n = globals().get("n", -1) + 1
        print(answers[n % len(answers)], flush=True)
    elif request["do"] == "tick":
        print(json.dumps(dict(leaf=request["leaf"], status="success")), flush=True)
    elif request["do"] in ("create", "halt"):
        print(json.dumps(dict(leaf=request["leaf"], done=True)), flush=True)
)");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string radius = R"({"ports":[{"name":"size.r","type":"double"}]})",
                    width = R"({"ports":[{"name":"size.w","type":"double"}]})";
  const std::tuple<std::string, std::string, int> rows[] = {
      {radius, "ok    'Shape' with kind=\"round\" has 2 ports", 0},
      {R"({"ports":[{"name":"radius","type":"double"}]})",
       "wrong 'Shape' with kind=\"round\" has the port 'radius', which no pattern of more_ports",
       4},
      {R"({"refused":"not now"})",
       "wrong 'Shape' has no element: describe refuses each choice and default of its fixed", 4},
      {R"({"refused":"not now"})" + ('\n' + width),
       "wrong 'Shape' with kind=\"round\" is described only when it is asked again: not now", 4},
      {radius + '\n' + width,
       "wrong 'Shape' with kind=\"round\" has other ports when it is described again: ", 4},
      {R"({"ports":[{"name":"size.r","type":"int"},{"name":"size.r","type":"int"}]})",
       "plugin 'area' is malformed: what it describes for 'Shape' ('Shape'): port 2 is named", 4},
      {R"({"ports":[{"name":"size.a","type":"number","direction":"output"}]})",
       "port 1 ('size.a') is an output of type number", 4}};
  for (const auto& [answers, message, code] : rows) {
    directory.file("answers", answers);
    const Outcome checked = check_plugin(program);
    INFO(answers << '\n' << checked.out << checked.err);
    CHECK(checked.code == code);
    CHECK(contains(checked.out, message));
    CHECK(!contains(checked.out, "LOCKSTEP_"));
  }
}

TEST_CASE("plugin check: what is no plugin, and an option for programs") {
  CHECK(contains(check_plugin("/nowhere/x.so").err, "there is no file '/nowhere/x.so'"));
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
