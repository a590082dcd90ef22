// Leaves with lockstep_leaf.py, the helper for Python, from outside.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

// The blocks of docs/programs.md under this heading that are of this kind.
std::string block_under(const std::string& heading, const std::string& kind) {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/programs.md");
  const std::string open = "\n```" + kind + "\n";
  const auto begin = page.find(open, page.find("\n## " + heading + "\n")) + open.size();
  return page.substr(begin, page.find("```\n", begin) - begin);
}

struct PythonLeaves {
  TemporaryDirectory directory;
  std::string program = directory.file("grip.py", block_under("In Python", "python"));
  PythonLeaves() { chmod(program.c_str(), 0755); }

  Outcome run_tree(const std::string& nodes) const {
    const std::string tree = directory.file(
        "tree.xml",
        "<root lockstep=\"1\"><plugin name=\"grip\" program=\"grip.py\"/><BehaviorTree "
        "ID=\"Main\"><Sequence memory=\"true\">" +
            nodes + "</Sequence></BehaviorTree></root>");
    return run_lockstep({"run", tree, "--plugin-path", directory.path(""), "--clock", "virtual",
                         "--max-ticks", "100"});
  }
};

}  // namespace

TEST_CASE("a leaf in Python sets ports that another reads, and its exception has file and line") {
  const PythonLeaves leaves;
  const Outcome good = leaves.run_tree(R"(<Grip width="{w}"/><IsClosed width="{w}"/>)");
  INFO(good.err);
  CHECK(good.code == 0);
  CHECK(contains(good.err, "Grip: success"));
  const Outcome bad = leaves.run_tree(R"(<Grip force="60"/>)");
  INFO(bad.err);
  CHECK(bad.code == 5);
  CHECK(contains(bad.err, "ValueError: too hard for the glass (grip.py:"));
  CHECK(contains(bad.err, "Grip: info: let go"));
  const Outcome unset = leaves.run_tree(R"(<IsClosed width="{w}"/>)");
  CHECK(unset.code == 5);
  CHECK(contains(unset.err, "the port 'width' has no value (grip.py:"));
}

TEST_CASE("a program in Python may have the name of a module that Python has") {
  const TemporaryDirectory directory;
  for (const std::string name : {"json", "random", "threading", "select"}) {
    const std::string program = directory.file(name + ".py", block_under("In Python", "python"));
    chmod(program.c_str(), 0755);
    const Outcome it = run_lockstep({"plugin", "check", "--list", program});
    INFO(it.err);
    CHECK(it.code == 0);
    std::filesystem::remove(program);
  }
}

TEST_CASE("plugin check --list saves what leaves a program has, and makes none") {
  const TemporaryDirectory directory;
  const std::string program = directory.file(
      "grip.py",
      "#!/usr/bin/python3\nfrom lockstep_leaf import Action, serve\nclass Grip(Action):\n"
      "    def __init__(self):\n        open('moved', 'w')\n    def tick(self):\n        return "
      "True\nserve()\n");
  chmod(program.c_str(), 0755);
  const Outcome listed =
      shell("lockstep plugin check --list --save ./grip.py && cat grip.leaves.json", directory);
  INFO(listed.out << listed.err);
  CHECK(listed.code == 0);
  CHECK(contains(listed.out, "that it has 'Grip'"));
  CHECK(contains(listed.out, "\"id\":\"Grip\""));
  CHECK_FALSE(std::filesystem::exists(directory.path("moved")));
  CHECK(shell("lockstep plugin check ./grip.py", directory).code == 0);
  CHECK(std::filesystem::exists(directory.path("moved")));
  CHECK(contains(shell("lockstep plugin check --list '" + abi_plugin("good") + "'", directory).err,
                 "--list is for programs"));
}

TEST_CASE("plugin check finds what a program does against the protocol, and saves its leaves") {
  const PythonLeaves leaves;
  const auto nodes = [&] { return run_lockstep({"nodes", "Grip", "--plugin", leaves.program}); };
  const Outcome unknown = nodes();
  CHECK(unknown.code == 4);
  CHECK(contains(unknown.err, "is a program, which this command does not run"));
  const Outcome checked = run_lockstep({"plugin", "check", leaves.program, "--save"});
  INFO(checked.out << checked.err);
  CHECK(checked.code == 0);
  CHECK(contains(checked.out, "ok    'Grip 1' answers halt\n"));
  CHECK(contains(checked.out, "ok    ends when its input is closed\n"));
  const Outcome known = nodes();
  CHECK(known.code == 0);
  CHECK(contains(known.out, "force  double in N, from 0 to 100, default 10"));

  chmod(leaves.directory.file("grip.py", "#!/bin/sh\necho hello\n").c_str(), 0755);
  const Outcome wrong = run_lockstep({"plugin", "check", leaves.program});
  CHECK(wrong.code == 4);
  CHECK(contains(wrong.out, "wrong it does not list its leaves: not JSON"));
  CHECK(nodes().code == 0);  // it was not run
}

TEST_CASE("what the author of a leaf in Python gets wrong is said in a sentence") {
  const PythonLeaves leaves;
  const auto say = [&](const std::string& body, const std::string& end = "serve()") {
    const std::string file = leaves.directory.file(
        "grip.py",
        "#!/usr/bin/python3\nfrom lockstep_leaf import Action, Output, Port, serve\n"
        "class Grip(Action):\n" +
            body + "\n" + end + "\n");
    chmod(file.c_str(), 0755);
    return leaves.run_tree("<Grip/>").err;
  };
  const std::string tick = "    def tick(self): return None\n";
  CHECK(contains(say(tick, ""), "this file has leaves, but does not call serve() at its end"));
  const std::string unfinished = say(tick, "1/0");
  CHECK(contains(unfinished, "ZeroDivisionError"));
  CHECK(!contains(unfinished, "serve()"));
  CHECK(contains(say("    progress: float = 0.0\n" + tick),
                 "a port cannot be called 'progress', as leaves have a progress already"));
  CHECK(contains(say("    force = Port(3)\n" + tick),
                 "the port 'force' has no type: force: float = Port("));
  CHECK(contains(say("    force: float = 3\n    def __init__(self): self.force\n" + tick),
                 "the port 'force' has no value yet: start and tick can read it (grip.py:5)"));
  CHECK(contains(say(tick + "    def progress(self): pass\n"),
                 "progress returned None, expected a number from 0 to 1"));
  const std::string nan = say(tick + "    def progress(self): return float('nan')\n");
  CHECK(contains(nan, "'Main/Sequence/Grip' (Grip of plugin 'grip')"));
  CHECK(contains(nan, "progress returned nan, expected a number from 0 to 1"));
  CHECK(contains(say("    width: Output[float]\n    def tick(self): self.width = float('inf')\n"),
                 "the port 'width' cannot be inf: expected a finite number (grip.py:5)"));
  CHECK(
      contains(say("    force: dict\n" + tick), "the port 'force' is a <class 'dict'>, expected"));
}

TEST_CASE("plugin check says nothing of the protocol of a program that does not start") {
  const TemporaryDirectory directory;
  const std::string program = directory.file("grip.py", "#!/nowhere/python\n");
  chmod(program.c_str(), 0755);
  const Outcome outcome = run_lockstep({"plugin", "check", program});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.out, "it does not start: No such file or directory"));
  CHECK(contains(outcome.out, "grip.py: was not examined\n"));
}

TEST_CASE("lines that a leaf writes from several threads stay whole") {
  const PythonLeaves leaves;
  const std::string file = leaves.directory.file("grip.py", R"(#!/usr/bin/python3
import threading
from lockstep_leaf import Action, say, serve

class Grip(Action):
    def tick(self):
        def write():
            for _ in range(50):
                self.log("x" * 20000, "debug")
                say(leaf=self._number, progress=0.5)
        threads = [threading.Thread(target=write) for _ in range(4)]
        for it in threads: it.start()
        for it in threads: it.join()
        return True

serve()
)");
  chmod(file.c_str(), 0755);
  const Outcome outcome = leaves.run_tree("<Grip/>");
  INFO(outcome.err.substr(0, 1000));
  CHECK(outcome.code == 0);
}

TEST_CASE("a program for lockstep that is started in a terminal asks for requests") {
  const PythonLeaves leaves;
  Process process({.arguments = {leaves.program},
                   .environment = {{"PYTHONPATH", LOCKSTEP_SOURCE_DIR "/plugins/sdk/python"}},
                   .program = "/usr/bin/python3"},
                  Process::Output::Terminal);
  REQUIRE(process.wait_for("> "));
  process.type("start Grip\ntick\n");
  CHECK(process.wait_for("\"progress\":0.05"));
  process.type("quit\n");
  CHECK(process.finish().code == 0);
}

TEST_CASE("a program is found by its name, or it is said what to type") {
  const PythonLeaves leaves;
  const std::string path = leaves.directory.path("");
  const auto ask = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--plugin-path", path});
    return run_lockstep(words);
  };
  for (const std::string name : {"grip", "grip.py"}) {
    const Outcome checked = ask({"plugin", "check", name});
    INFO(name << checked.out << checked.err);
    CHECK(checked.code == 0);
    CHECK(contains(checked.out, "grip.py: ok\n"));
    const Outcome nodes = ask({"nodes", "Grip", "--run-programs", "--plugin", name});
    INFO(nodes.err);
    CHECK(nodes.code == 0);
    CHECK(contains(nodes.out, "Closes the gripper."));
    CHECK(contains(ask({"nodes", "Grip", "--plugin", name}).err,
                   "grip.py' is a program, which this command does not run"));
  }
  const Outcome none = ask({"plugin", "check", "grap"});
  CHECK(none.code == 2);
  CHECK(contains(none.err, "'grap' is not a plugin"));
  const std::string tree = leaves.directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"grip\"/><BehaviorTree ID=\"Main\"><Grip/>"
      "</BehaviorTree></root>");
  const Outcome asked = ask({"check", tree});
  CHECK(asked.code == 4);
  CHECK(contains(asked.err, R"('grip.py' is a program: <plugin name="grip" program="grip.py"/>)"));
}

TEST_CASE("leaves that were saved before the program has changed are named") {
  const PythonLeaves leaves;
  REQUIRE(run_lockstep({"plugin", "check", leaves.program, "--save"}).code == 0);
  const std::string nodes = R"(<Grip width="{w}"/>)";
  CHECK(!contains(leaves.run_tree(nodes).err, "grip.leaves.json"));
  std::string text = read_file(leaves.program);
  text.replace(text.find("force: float"), 12, "power: float");
  text.replace(text.find("self.force"), 10, "self.power");
  leaves.directory.file("grip.py", text);
  const Outcome run = leaves.run_tree(nodes);
  CHECK(run.code == 0);
  CHECK(contains(run.err, "has other leaves than"));
  CHECK(contains(run.err, "let 'lockstep plugin check --list --save "));
  const auto check = [&](bool runs) {
    std::vector<std::string> words = {"check", leaves.directory.path("tree.xml"), "--plugin-path",
                                      leaves.directory.path("")};
    if (runs) words.push_back("--run-programs");
    return run_lockstep(words);
  };
  CHECK(contains(check(true).err, "has other leaves than"));
  // Without running it, the time of the file says that it may be so.
  const auto age = [&](std::chrono::seconds older) {
    using std::filesystem::last_write_time;
    last_write_time(leaves.directory.path("grip.leaves.json"),
                    last_write_time(leaves.program) - older);
  };
  age(std::chrono::seconds(5));
  CHECK(contains(check(false).err, "is older than the program"));
  CHECK(check(false).code == 0);
  age(std::chrono::seconds(0));
  CHECK(!contains(check(false).err, "is older than"));
}

TEST_CASE("python3 -m lockstep_leaf tries leaves by hand") {
  const PythonLeaves leaves;
  const Outcome outcome =
      run({.arguments = {"-m", "lockstep_leaf", leaves.program},
           .environment = {{"PYTHONPATH", LOCKSTEP_SOURCE_DIR "/plugins/sdk/python"}},
           .input = "start Grip force=20\ntick 2\nhalt\nstart Grip force=60\ntick\nquit\n",
           .program = "/usr/bin/python3"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "Grip (action) force:double width:double\n"));
  CHECK(contains(outcome.out,
                 R"({"leaf":1,"status":"running","progress":0.1,"set":{"width":0.09}})"));
  CHECK(contains(outcome.out, R"({"leaf":1,"log":"let go","level":"info"})"));
  CHECK(contains(outcome.out, R"("error":"ValueError: too hard for the glass (grip.py:)"));
}
