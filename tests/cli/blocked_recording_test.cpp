// A recording on a disk that takes no more, seen from outside: what is told, and that the user can
// always end the program.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

// A named pipe of one page that somebody has opened and does not read.
class StuckPipe {
 public:
  explicit StuckPipe(const TemporaryDirectory& directory) : path_(directory.path("pipe")) {
    REQUIRE(mkfifo(path_.c_str(), 0600) == 0);
    file_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(file_ >= 0);
    constexpr int kPage = 4096;
    REQUIRE(fcntl(file_, F_SETPIPE_SZ, kPage) == kPage);
    REQUIRE(fcntl(file_, F_SETFL, 0) == 0);
  }
  ~StuckPipe() { close(file_); }
  StuckPipe(const StuckPipe&) = delete;
  StuckPipe& operator=(const StuckPipe&) = delete;

  const std::string& path() const { return path_; }
  // Reads no further than the end of a line.
  void read_line() const {
    pollfd writer{file_, POLLIN, 0};  // before one comes, a pipe is at its end
    REQUIRE(poll(&writer, 1, 60'000) == 1);
    for (char byte = 0; byte != '\n';) REQUIRE(read(file_, &byte, 1) == 1);
  }

 private:
  std::string path_;
  int file_ = -1;
};

// Says in each tick that it is ticked. What it and 200 others do takes more than a page.
std::string busy_tree(const TemporaryDirectory& directory) {
  std::string nodes = "<Probe name=\"talks\" ticks=\"1000000\"/>";
  for (int i = 0; i < 200; ++i) nodes += "<Advance step=\"0.000001\"/>";
  return directory.file("tree.xml", tree_text("<Parallel>" + nodes + "</Parallel>"));
}

Invocation recorded(const std::string& tree, const std::string& file) {
  return {.arguments = {"run", tree, "--rate", "1000", "--view", "none", "--record", file,
                        "--plugin", LOCKSTEP_BINARY_DIR "/tests/abi/plugins/good.so"}};
}

}  // namespace

TEST_CASE("a run whose recording waits for its reader without end is ended by a second signal") {
  const TemporaryDirectory directory;
  const StuckPipe pipe(directory);
  Invocation call = recorded(busy_tree(directory), pipe.path());
  call.arguments.insert(call.arguments.end(), {"--halt-limit", "0"});
  Process process(call);
  pipe.read_line();  // the header, which the first tick waits for
  std::string ticks;
  for (int tick = 0; tick < 3; ++tick) ticks += "Main/Parallel/talks: info: tick\n";
  REQUIRE(process.wait_for(ticks));  // ticks do not wait
  process.signal(SIGINT);
  REQUIRE(process.wait_for("Main/Parallel/talks: info: halt\n"));
  process.signal(SIGTERM);
  const Outcome outcome = process.finish();
  CHECK(outcome.code == 143);
  CHECK(outcome.out.empty());  // it came to no summary
}

TEST_CASE("a run whose recording nobody reads ends all the same, and says so") {
  const TemporaryDirectory directory;
  const StuckPipe pipe(directory);
  Invocation call = recorded(busy_tree(directory), pipe.path());
  call.arguments.insert(call.arguments.end(),
                        {"--halt-limit", "0.2", "--timeout", "0.5", "--json"});
  Process process(call);
  pipe.read_line();
  const Outcome outcome = process.finish();
  INFO(outcome.err.substr(0, 2000));
  CHECK(outcome.code == 124);
  CHECK(contains(outcome.err, "no process read anything for 0.1 s at the end of the run"));
  CHECK(contains(outcome.out, "cannot write"));
}

TEST_CASE("a run whose recording has no room for its header is ended by a second signal") {
  const TemporaryDirectory directory;
  const StuckPipe pipe(directory);
  Process process(recorded(busy_tree(directory), pipe.path()));
  REQUIRE(process.wait_for("Main/Parallel/talks: info: create\n"));
  process.signal(SIGTERM);
  process.signal(SIGINT);  // of another number, so that both arrive
  const Outcome outcome = process.finish();
  CHECK((outcome.code == 130 || outcome.code == 143));
  CHECK(outcome.out.empty());
}

}  // namespace lockstep::host::test
