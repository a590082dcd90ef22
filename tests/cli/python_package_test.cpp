// The package lockstep for Python: from the sources, and installed into a venv without a network.
#include <catch2/catch.hpp>
#include <filesystem>

#include "cli/program.h"
#include "support/paths.h"

using namespace lockstep::test;

namespace {

Outcome python(std::vector<std::string> arguments, const std::string& path,
               const std::string& program = "/usr/bin/python3") {
  return run({.arguments = std::move(arguments),
              .environment = {{"PYTHONPATH", path}, {"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"}},
              .program = program});
}

const std::string kPackage = LOCKSTEP_SOURCE_DIR "/python";

}  // namespace

TEST_CASE("Python runs trees, and reads recordings and studies") {
  const TemporaryDirectory directory;
  const std::string script = directory.file("use.py", R"(
import sys, lockstep
tree = sys.argv[1] + "/trees/door_pulling.xml"
run = lockstep.run(tree, args={"barriers": [0.5]}, seed=3, record=sys.argv[2])
print(run.result, run.code)
rows = lockstep.read(sys.argv[2])
rows = rows if isinstance(rows, list) else rows.to_dict("records")
print(len(rows) > 100, sorted(rows[0]))
rows = lockstep.study(tree, runs=3, grid={"barriers": ["", "0.5"]}, measure=["spread"])
rows = rows if isinstance(rows, list) else rows.to_dict("records")
print(len(rows), [row["result"] for row in rows])
try:
    lockstep.run("none.xml")
except lockstep.Error as error:
    print(error.code, error)
)");
  const Outcome outcome =
      python({script, LOCKSTEP_SOURCE_DIR, directory.path("run.jsonl")}, kPackage);
  INFO(outcome.err);
  CHECK(outcome.out ==
        "success 0\n"
        "True ['held', 'node', 'path', 'progress', 'status', 'tick', 'ticked', 'time_s']\n"
        "6 ['failure', 'failure', 'failure', 'success', 'success', 'success']\n"
        "3 none.xml: error: cannot be read: No such file or directory\n");
}

TEST_CASE("docs/programs.md: a tree in Python with the leaves of a program") {
  const std::string page = read_file(LOCKSTEP_SOURCE_DIR "/docs/programs.md");
  const auto block = [&](const std::string& heading) {
    const std::string open = "\n```python\n";
    const auto begin = page.find(open, page.find("\n## " + heading + "\n")) + open.size();
    return page.substr(begin, page.find("```\n", begin) - begin);
  };
  const TemporaryDirectory directory;
  directory.file("grip.py", block("In Python"));
  directory.file("tree.xml",
                 "<root lockstep=\"1\"><plugin name=\"grip\" program=\"grip.py\"/>"
                 "<BehaviorTree ID=\"Main\"><Sequence memory=\"true\"><Grip width=\"{w}\"/>"
                 "<IsClosed width=\"{w}\"/></Sequence></BehaviorTree></root>");
  const Outcome outcome =
      run({.arguments = {"-c", "cd '" + directory.path("") + "' && /usr/bin/python3 use.py"},
           .environment = {{"PYTHONPATH", kPackage},
                           {"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"},
                           {"LD_PRELOAD", LOCKSTEP_PRELOAD},
                           {"ASAN_OPTIONS", "detect_leaks=0"},
                           {"USE", directory.file("use.py", block("Trees in Python"))}},
           .program = "/bin/sh"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "0.03 {'w': 0.095}\n0.05 {'w': 0.09}\n"));
  CHECK(lines(outcome.out).size() == 19);
}

TEST_CASE("docs/paper/figure3.py makes the figure: more barriers, better predictability") {
  const Outcome outcome = python({LOCKSTEP_SOURCE_DIR "/docs/paper/figure3.py", "5"}, kPackage);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "noise 0.05: the median of the predictability distance"));
  CHECK(lines(outcome.out).size() == 12);
  CHECK(contains(outcome.out, "  20 barriers    -4"));
}

TEST_CASE("the package installs into a venv without an index") {
  const TemporaryDirectory directory;
  const std::string venv = directory.path("venv");
  if (python({"-c", "import setuptools, ensurepip"}, "").code != 0) return;
  REQUIRE(python({"-m", "venv", "--system-site-packages", venv}, "").code == 0);
  std::filesystem::copy(kPackage, directory.path("sources"),
                        std::filesystem::copy_options::recursive);
  const Outcome installed = python({"-m", "pip", "install", "-q", "--no-index",
                                    "--no-build-isolation", directory.path("sources")},
                                   "", venv + "/bin/python3");
  INFO(installed.err);
  REQUIRE(installed.code == 0);
  const Outcome outcome =
      python({"-c", "import lockstep, lockstep_leaf; print(lockstep.__file__, lockstep.program())"},
             "", venv + "/bin/python3");
  CHECK(contains(outcome.out, venv));
  const std::string tree = LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml";
  const Outcome ticked =
      run({.arguments = {"-c", "import lockstep; print(lockstep.Tree('" + tree + "').run())"},
           .environment = {{"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"},
                           {"LD_PRELOAD", LOCKSTEP_PRELOAD},
                           {"ASAN_OPTIONS", "detect_leaks=0"}},
           .program = venv + "/bin/python3"});
  INFO(ticked.err);
  CHECK(ticked.out == "<lockstep run: success after 701 ticks>\n");
  CHECK(contains(outcome.out, LOCKSTEP_BINARY_DIR "/lockstep"));
}
