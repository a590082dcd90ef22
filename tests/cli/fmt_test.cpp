// lockstep fmt: which files it writes, what it says, how it ends.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kUgly =
    "<root lockstep=\"1\"><BehaviorTree ID=\"A\"><AlwaysSuccess /></BehaviorTree></root>";
const std::string kNice = R"(<root lockstep="1">
  <BehaviorTree ID="A">
    <AlwaysSuccess/>
  </BehaviorTree>
</root>
)";

}  // namespace

TEST_CASE("the trees of this project are as fmt writes them") {
  const Outcome outcome = run_lockstep({"fmt", "--check", LOCKSTEP_SOURCE_DIR "/trees"});
  CHECK(outcome.out.empty());
  CHECK(outcome.code == 0);
}

TEST_CASE("fmt writes a file, and leaves one alone that is as it should be") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a.xml", kUgly);
  CHECK(run_lockstep({"fmt", "--check", file}).code == 1);
  CHECK(run_lockstep({"fmt", "--check", file}).out == file + "\n");
  CHECK(contains(run_lockstep({"fmt", "--diff", file}).out, "+  <BehaviorTree ID=\"A\">\n"));
  CHECK(read_file(file) == kUgly);
  const Outcome outcome = run_lockstep({"fmt", file});
  CHECK(outcome.code == 0);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, "1 file formatted"));
  CHECK(read_file(file) == kNice);
  struct stat before {
  }, after{};
  stat(file.c_str(), &before);
  CHECK(run_lockstep({"fmt", file}).code == 0);
  stat(file.c_str(), &after);
  CHECK(before.st_ino == after.st_ino);
  CHECK(run_lockstep({"fmt", "--check", file}).code == 0);
}

TEST_CASE("fmt keeps the mode of a file, a link to it, its byte order mark and its line ends") {
  const TemporaryDirectory directory;
  const std::string file =
      directory.file("a.xml", "\xEF\xBB\xBF<root lockstep=\"1\">\r\n<!--a\r\nb--></root>");
  const std::string link = directory.path("link.xml");
  REQUIRE(chmod(file.c_str(), 0640) == 0);
  REQUIRE(symlink("a.xml", link.c_str()) == 0);
  CHECK(run_lockstep({"fmt", link}).code == 0);
  CHECK(read_file(file) == "\xEF\xBB\xBF<root lockstep=\"1\">\r\n  <!--a\r\n  b-->\r\n</root>\r\n");
  struct stat state {};
  REQUIRE(lstat(link.c_str(), &state) == 0);
  CHECK(S_ISLNK(state.st_mode));
  REQUIRE(stat(file.c_str(), &state) == 0);
  CHECK((state.st_mode & 0777u) == 0640u);
}

TEST_CASE("fmt leaves a file alone whose layout no command could read") {
  const TemporaryDirectory directory;
  constexpr int kDepth = 200, kLeaves = 180'000;
  std::string text = "<root lockstep=\"1\"><BehaviorTree ID=\"A\">",
              end = "</BehaviorTree></root>\n";
  for (int i = 0; i < kDepth; ++i) {
    text += "<Sequence>";
    end = "</Sequence>" + end;
  }
  for (int i = 0; i < kLeaves; ++i) text += "<AlwaysSuccess/>";
  text += end;
  const std::string file = directory.file("deep.xml", text);
  const Outcome outcome = run_lockstep({"fmt", file});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "it would be larger than 64 MiB"));
  CHECK((read_file(file) == text));
}

TEST_CASE("fmt takes folders, and leaves files of other programs alone") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("a.xml", kUgly);
  const std::string package = directory.file("package.xml", "<package ><name>a</name></package>");
  const std::string broken = directory.file("broken.xml", "<a><b></a>");
  const std::string scenarios = directory.file("a.test.xml", "<scenarios lockstep=\"1\" />");
  const std::string theirs = directory.file("b.xml", "<root BTCPP_format=\"4\"></root>");
  const Outcome outcome = shell("lockstep fmt", directory);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "3 files formatted"));
  CHECK(read_file(tree) == kNice);
  CHECK(read_file(scenarios) == "<scenarios lockstep=\"1\"/>\n");
  CHECK(read_file(package) == "<package ><name>a</name></package>");
  CHECK(read_file(broken) == "<a><b></a>");
  CHECK(read_file(theirs) == "<root BTCPP_format=\"4\"></root>\n");
  const Outcome named = run_lockstep({"fmt", package});
  CHECK(named.code == 3);
  CHECK(contains(named.err, "its root is 'package'"));
}

TEST_CASE("fmt does not touch a file with an error, and goes on with the others") {
  const TemporaryDirectory directory;
  const std::string broken = "<root lockstep=\"1\">\n<Sequence>\n</root>";
  const std::string file = directory.file("a.xml", broken);
  const std::string other = directory.file("b.xml", kUgly);
  const Outcome outcome = run_lockstep({"fmt", file, other});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "a.xml:3:1: error: "));
  CHECK(read_file(file) == broken);
  CHECK(read_file(other) == kNice);
  const Outcome text =
      run_lockstep({"fmt", directory.file("c.xml", "<root lockstep=\"1\">a</root>")});
  CHECK(text.code == 3);
  CHECK(contains(text.err, "text is not part of the language"));
  CHECK(run_lockstep({"fmt", directory.path("none.xml")}).code == 3);
}

TEST_CASE("fmt reads stdin and writes the text to stdout") {
  const Outcome outcome = run({.arguments = {"fmt", "-"}, .input = kUgly});
  CHECK(outcome.code == 0);
  CHECK(outcome.out == kNice);
  CHECK(outcome.err.empty());
  CHECK(run({.arguments = {"fmt", "-"}, .input = kNice}).out == kNice);
  const Outcome check = run({.arguments = {"fmt", "--check", "-"}, .input = kUgly});
  CHECK(check.code == 1);
  CHECK(check.out == "stdin\n");
  const Outcome broken = run({.arguments = {"fmt", "-"}, .input = "<root"});
  CHECK(broken.code == 3);
  CHECK(broken.out.empty());
}

TEST_CASE("the diff of fmt is one that patch reads") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a.xml", kUgly);
  const Outcome outcome =
      shell("lockstep fmt --diff a.xml | patch -s a.xml && lockstep fmt --check a.xml", directory);
  INFO(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(read_file(file) == kNice);
}
