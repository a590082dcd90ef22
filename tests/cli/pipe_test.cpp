// A tree that comes through a pipe: only as the file that the user names, and only once.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

const std::string kPipeTree =
    "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/></BehaviorTree></root>\n";

}  // namespace

TEST_CASE("a tree is read from stdin, from a pipe and from a process substitution") {
  const TemporaryDirectory directory;
  directory.file("tree.xml", kPipeTree);
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"cat tree.xml | lockstep check -", "stdin: ok\n"},
      {"lockstep check - < tree.xml", "stdin: ok\n"},
      {"cat tree.xml | lockstep check /dev/stdin", "/dev/stdin: ok\n"},
      {"lockstep check /dev/stdin < tree.xml", "/dev/stdin: ok\n"},
      {"lockstep check <(cat tree.xml) | sed 's/[0-9]*:/:/'", "/dev/fd/: ok\n"},
      {"lockstep check <(cat tree.xml) <(cat tree.xml) | sed 's/[0-9]*:/:/'",
       "/dev/fd/: ok\n/dev/fd/: ok\n"},
      {"mkfifo f && { cat tree.xml > f & } && lockstep check f", "f: ok\n"},
      {"cat tree.xml | lockstep show -", "Main\n`-- AlwaysSuccess\n"},
      {"cat tree.xml | lockstep run - --clock virtual --view none | head -c 7", "success"}};
  for (const auto& [script, out] : rows) {
    const Outcome outcome = shell(script, directory);
    INFO(script << '\n' << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == out);
  }
}

TEST_CASE("what is wrong with a tree from stdin is reported there, and its includes are found") {
  const TemporaryDirectory directory;
  directory.file("part.xml",
                 "<root lockstep=\"1\"><BehaviorTree ID=\"B\"><X/></BehaviorTree></root>");
  directory.file("tree.xml",
                 "<root lockstep=\"1\">\n<include path=\"part.xml\"/>\n<BehaviorTree "
                 "ID=\"A\"><Y/></BehaviorTree></root>");
  const Outcome outcome = shell("cat tree.xml | lockstep check - --tree A", directory);
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "stdin:3:22: error: unknown node 'Y'"));
  CHECK(contains(outcome.err, "part.xml:1:41: error: unknown node 'X'"));
}

TEST_CASE("a pipe has the limit of a file, and its writer is not kept waiting") {
  const TemporaryDirectory directory;
  const Outcome outcome = shell("yes '<a/>' | lockstep check -; echo ${PIPESTATUS[@]}", directory);
  CHECK(contains(outcome.err, "stdin: error: the file is larger than 64 MiB"));
  CHECK(outcome.out == "141 3\n");  // yes has got SIGPIPE
}

TEST_CASE("devices, and pipes that no user has named, are not read") {
  const TemporaryDirectory directory;
  directory.file("tree.xml", kPipeTree);
  const std::string includes = "<root lockstep=\"1\"><include path=\"";
  directory.file("fifo.xml", includes + "f\"/></root>");
  directory.file("stdin.xml", includes + "/dev/stdin\"/></root>");
  directory.file("dash.xml", includes + "-\"/></root>");
  directory.file("descriptor.xml", includes + "/dev/fd/0\"/></root>");
  const std::string neither = "cannot be read: it is neither a regular file nor a pipe";
  const std::string regular = "it is not a regular file";
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"lockstep check /dev/zero", neither},
      {"lockstep check - < /dev/zero", neither},
      {"lockstep check /dev/stdin < /dev/zero", neither},
      {"lockstep check - < /dev/null", neither},
      {"lockstep check - <&-", neither},  // which is /dev/null by then
      {"lockstep run .", "Is a directory"},
      {"mkfifo f; lockstep check fifo.xml", regular},
      {"cat tree.xml | lockstep check stdin.xml", regular},
      {"cat tree.xml | lockstep check descriptor.xml", regular},
      {"cat tree.xml | lockstep check dash.xml", "cannot read '-': No such file"},
      // A study reads its tree again and again.
      {"lockstep study --runs 1 --out s <(cat tree.xml)", regular},
      {"cat tree.xml | lockstep study --runs 1 --out s /dev/stdin", regular}};
  for (const auto& [script, message] : rows) {
    const Outcome outcome = shell(script, directory);
    INFO(script << '\n' << outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, message));
  }
  // stdin as a terminal: nothing would tell that a tree is to be typed.
  const Outcome typed = Process({.arguments = {"check", "-"}}, Process::Output::Terminal).finish();
  CHECK(typed.code == 3);
  CHECK(contains(typed.out, neither));
}

TEST_CASE("a signal ends the waiting for the writer of a pipe") {
  const TemporaryDirectory directory;
  const std::string fifo = directory.path("fifo");
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  for (const std::string command : {"check", "run"}) {
    Process process({.arguments = {command, fifo}});
    // Returns when the program has opened the pipe, and is about to read from it.
    const int writer = open(fifo.c_str(), O_WRONLY | O_CLOEXEC);
    REQUIRE(writer >= 0);
    process.signal(SIGINT);
    const Outcome outcome = process.finish();
    close(writer);
    INFO(outcome.err);
    CHECK(outcome.code == 130);
  }
}

}  // namespace lockstep::host::test
