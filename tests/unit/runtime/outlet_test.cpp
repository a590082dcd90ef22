// Where lockstep speaks to a person: what a reader gets who reads, stops reading, or is not there.
#include "base/terminal/outlet.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <string>
#include <thread>
#include <vector>

#include "base/system/descriptors.h"

namespace lockstep::host {
namespace {

constexpr int kPage = 4096;

// A pipe of one page. Nobody reads it until read() is called.
class OnePage {
 public:
  OnePage() {
    REQUIRE(pipe2(ends_, O_CLOEXEC) == 0);
    REQUIRE(fcntl(ends_[1], F_SETPIPE_SZ, kPage) == kPage);
  }
  ~OnePage() {
    stop_reading();
    if (ends_[1] >= 0) close(ends_[1]);
  }
  OnePage(const OnePage&) = delete;
  OnePage& operator=(const OnePage&) = delete;

  int file() const { return ends_[1]; }
  void stop_reading() {
    if (ends_[0] >= 0) close(ends_[0]);
    ends_[0] = -1;
  }
  // Its number is nobody else's from now on.
  void leave_open() { ends_[1] = -1; }
  // Until `last` has come.
  std::string read_to(const std::string& last) const {
    std::string text;
    char buffer[kPage];
    while (!text.ends_with(last)) {
      const ssize_t count = read(ends_[0], buffer, sizeof buffer);
      REQUIRE(count > 0);
      text.append(buffer, static_cast<std::size_t>(count));
    }
    return text;
  }
  void wait_for_text() const {
    pollfd reader{ends_[0], POLLIN, 0};
    REQUIRE(poll(&reader, 1, -1) == 1);
  }
  bool is_empty() const {
    pollfd reader{ends_[0], POLLIN, 0};
    return poll(&reader, 1, 0) == 0;
  }

 private:
  int ends_[2];
};

std::string line_of(std::size_t size) {
  return std::string(size - 1, 'x') + "\n";
}

// More than the pipe and the queue take together.
constexpr std::size_t kLines = 2 * Outlet::kRoom / 1024;

TEST_CASE("outlet: what is said arrives in order, directly and through a thread") {
  OnePage pipe;
  Outlet outlet(pipe.file());
  outlet.say("before\n");
  {
    const Outlet::Thread thread(outlet);
    for (int i = 0; i < 9; ++i) outlet.say(std::to_string(i) + "\n");
    CHECK(outlet.flush(Outlet::kPatience));
  }
  outlet.say("after\n");
  CHECK(pipe.read_to("after\n") == "before\n0\n1\n2\n3\n4\n5\n6\n7\n8\nafter\n");
  CHECK(outlet.lost().lines == 0);
}

TEST_CASE("outlet: lines of many threads stay whole") {
  OnePage pipe;
  Outlet outlet(pipe.file());
  const Outlet::Thread thread(outlet);
  {
    std::vector<std::jthread> threads;
    for (const char name : {'a', 'b', 'c'}) {
      threads.emplace_back([&outlet, name] {
        for (int i = 0; i < 100; ++i) outlet.say(std::string(9, name) + "\n");
      });
    }
  }
  outlet.say("end\n");
  const std::string text = pipe.read_to("end\n");
  CHECK(text.size() == 3004);
  for (std::size_t at = 0; at < 3000; at += 10) {
    CHECK(text.substr(at, 10) == std::string(9, text[at]) + "\n");
  }
}

TEST_CASE("outlet: whoever speaks does not wait for a reader, who is told what is missing") {
  constexpr std::size_t kQueued = Outlet::kRoom / 1024;
  OnePage pipe;
  Outlet outlet(pipe.file());
  const Outlet::Thread thread(outlet);
  outlet.say(line_of(2 * kPage));
  pipe.wait_for_text();  // from now on the thread waits for us
  for (std::size_t i = 0; i < kLines; ++i) outlet.say(line_of(1024));
  const std::string text = pipe.read_to("no process read them\n");
  const std::size_t arrived = 2 * kPage + kQueued * 1024;
  REQUIRE(text.size() > arrived);
  CHECK(text.substr(arrived) == "lockstep: warning: " + std::to_string(kLines - kQueued) +
                                    " lines are lost here: no process read them\n");
  CHECK(outlet.lost().lines == kLines - kQueued);
  outlet.say("goes on\n");
  CHECK(pipe.read_to("goes on\n") == "goes on\n");
}

TEST_CASE("outlet: a reader who never reads costs a limited time at the end, and all is counted") {
  OnePage pipe;
  Outlet outlet(pipe.file());
  const auto begin = std::chrono::steady_clock::now();
  {
    const Outlet::Thread thread(outlet);
    for (std::size_t i = 0; i < kLines; ++i) outlet.say(line_of(1024));
    CHECK_FALSE(outlet.flush(std::chrono::milliseconds(1)));
  }
  CHECK(std::chrono::steady_clock::now() - begin < 20 * Outlet::kPatience);
  outlet.say("too late\n");
  CHECK_FALSE(outlet.show("too late\n"));
  CHECK(outlet.lost().lines > kLines - Outlet::kRoom / 1024);
  CHECK(outlet.lost().lines <= kLines + 1);
  CHECK(outlet.lost().reason == 0);
  pipe.leave_open();  // for the thread, which goes when nobody can read any more
}

TEST_CASE("outlet: a picture is shown as a whole, or not while something waits") {
  OnePage pipe;
  Outlet outlet(pipe.file());
  const Outlet::Thread thread(outlet);
  const std::string large = line_of(2 * Outlet::kRoom);
  CHECK(outlet.show(large));
  CHECK_FALSE(outlet.show("second\n"));  // the first fills the pipe
  outlet.say("a line is not a picture\n");
  CHECK(pipe.read_to("picture\n") == large + "a line is not a picture\n");
  CHECK(outlet.flush(Outlet::kPatience));
  CHECK(outlet.show("third\n"));
  CHECK(pipe.read_to("third\n") == "third\n");
  CHECK(outlet.lost().lines == 0);
}

TEST_CASE("outlet: what cannot be written is counted with its reason") {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  Outlet outlet(full);
  outlet.say("one\ntwo\n");
  {
    const Outlet::Thread thread(outlet);
    outlet.say("three\n");
  }
  CHECK(outlet.lost().lines == 3);
  CHECK(outlet.lost().reason == ENOSPC);
  close(full);
}

TEST_CASE("outlet: the reader who comes back is told what a full disk has cost") {
  OnePage pipe;
  const int file = fcntl(open("/dev/full", O_WRONLY | O_CLOEXEC), F_DUPFD_CLOEXEC, 0);
  Outlet outlet(file);
  outlet.say("one\ntwo\n");
  REQUIRE(dup2(pipe.file(), file) == file);
  outlet.say("three\n");
  CHECK(pipe.read_to("three\n") ==
        "lockstep: warning: 2 lines are lost here: No space left on device\nthree\n");
  close(file);
}

TEST_CASE("write_all waits until it is to give up, and then not at all") {
  const auto always = [] { return true; };
  OnePage pipe;
  CHECK(write_all(pipe.file(), line_of(kPage), always));
  CHECK_FALSE(write_all(pipe.file(), "more", always));
  CHECK(errno == EINTR);
  CHECK(pipe.read_to("x\n") == line_of(kPage));
  CHECK(pipe.is_empty());
  pipe.stop_reading();
  signal(SIGPIPE, SIG_IGN);
  CHECK_FALSE(write_all(pipe.file(), "more", always));
  CHECK(errno == EPIPE);
}

TEST_CASE("write_now never waits") {
  OnePage pipe;
  write_now(pipe.file(), line_of(3 * kPage));
  CHECK(pipe.read_to(std::string(kPage, 'x')).size() == kPage);
  CHECK(pipe.is_empty());
  write_now(pipe.file(), "again\n");
  CHECK(pipe.read_to("\n") == "again\n");
}

}  // namespace
}  // namespace lockstep::host
