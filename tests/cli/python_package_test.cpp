// The package lockstep for Python: from the sources, and installed by pip without a network.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

Outcome python(std::vector<std::string> arguments, const std::string& path,
               const std::string& program = "/usr/bin/python3") {
  return run({.arguments = std::move(arguments),
              .environment = {{"PYTHONPATH", path}, {"LOCKSTEP", LOCKSTEP_BINARY_DIR "/lockstep"}},
              .program = program});
}

const std::string kPackage = LOCKSTEP_SOURCE_DIR "/plugins/sdk/python";

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
  CHECK(
      outcome.out ==
      "success 0\n"
      "True ['held', 'node', 'path', 'progress', 'results', 'status', 'tick', 'ticked', 'time_s']\n"
      "6 ['failure', 'failure', 'failure', 'success', 'success', 'success']\n"
      "3 none.xml: error: cannot be read: No such file or directory [unreadable-file]\n");
}

#if !defined(__SANITIZE_THREAD__)  // whose runtime cannot be loaded into Python

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

#endif

TEST_CASE("docs/paper/figure3.py makes the figure: more barriers, better predictability") {
  const Outcome outcome = python({LOCKSTEP_SOURCE_DIR "/docs/paper/figure3.py", "5"}, kPackage);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "noise 0.05: the median of the predictability distance"));
  CHECK(lines(outcome.out).size() == 12);
  CHECK(contains(outcome.out, "  20 barriers    -4"));
}

TEST_CASE("pip installs the package of an installation, and writes nothing into that") {
  namespace fs = std::filesystem;
  if (python({"-c", "import ensurepip"}, "").code != 0) return;
  const TemporaryDirectory directory;
  const fs::path installation = directory.path("lockstep");
  const fs::path sources = installation / "share/lockstep/python";
  for (const char* folder : {"bin", "lib", "share/lockstep"}) {
    fs::create_directories(installation / folder);
  }
  fs::copy(LOCKSTEP_BINARY_DIR "/lockstep", installation / "bin");
  fs::copy(LOCKSTEP_BINARY_DIR "/liblockstep-runtime.so",
           installation / "lib/liblockstep-runtime.so");
  fs::copy(kPackage, sources, fs::copy_options::recursive);
  for (const char* part : {"", "lockstep", "for_pip"})
    fs::remove_all(sources / part / "__pycache__");
  const auto files = [&] {
    std::set<std::string> all;
    for (const auto& it : fs::recursive_directory_iterator(installation)) all.insert(it.path());
    return all;
  };
  const auto before = files();
  const std::string venv = directory.path("venv"), of_venv = venv + "/bin/python3";
  REQUIRE(python({"-m", "venv", venv}, "").code == 0);
  // As that of a later Python: it has neither setuptools nor wheel.
  python({"-m", "pip", "uninstall", "-q", "-y", "setuptools"}, "", of_venv);
  const Outcome installed =
      python({"-m", "pip", "install", "-q", "--no-index", sources}, "", of_venv);
  INFO(installed.err);
  REQUIRE(installed.code == 0);
  CHECK(files() == before);
  const std::string use =
      "import lockstep, lockstep_leaf, lockstep._program as it\n"
      "print(lockstep.__file__, it.program(), it.library())\n"
      "tree = '<root lockstep=\"1\"><BehaviorTree "
      "ID=\"M\"><AlwaysSuccess/></BehaviorTree></root>'\n"
      "print(lockstep.Tree(text=tree).run())\n";
  const auto used = [&](const std::string& path) {
    const Outcome outcome = run({.arguments = {"-c", use},
                                 .environment = {{"LOCKSTEP", ""},
                                                 {"PATH", path},
                                                 {"PYTHONPATH", ""},
                                                 {"LD_PRELOAD", LOCKSTEP_PRELOAD},
                                                 {"ASAN_OPTIONS", "detect_leaks=0"}},
                                 .program = of_venv});
    INFO(outcome.err);
    CHECK(contains(outcome.out, "<lockstep run: success after 1 ticks>\n"));
    return lines(outcome.out).front();
  };
  const std::string package = used("/usr/bin:/bin");
  CHECK(contains(package, venv));
  CHECK(contains(package, " " + installation.string() + "/bin/lockstep "));
  CHECK(contains(package, " " + installation.string() + "/lib/liblockstep-runtime.so"));
  fs::remove_all(installation);  // then PATH names another one
  CHECK(contains(used(LOCKSTEP_BINARY_DIR ":/usr/bin:/bin"), " " LOCKSTEP_BINARY_DIR "/lockstep "));
}
