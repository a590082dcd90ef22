// Changing a file that people keep: what stays, and what is refused.
#include "base/system/replace_text.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

struct stat state_of(const std::string& path) {
  struct stat state {};
  REQUIRE(stat(path.c_str(), &state) == 0);
  return state;
}

// Files of that folder.
std::size_t count_files(const TemporaryDirectory& directory) {
  const std::filesystem::directory_iterator begin(directory.path("")), end;
  return static_cast<std::size_t>(std::distance(begin, end));
}

// No file of this process grows beyond it.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal_ = signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int) = nullptr;
};

}  // namespace

TEST_CASE("a text is replaced, with the mode and the attributes of its file, through a link") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "old"), link = directory.path("link");
  REQUIRE(chmod(file.c_str(), 0640) == 0);
  const bool has_attributes = setxattr(file.c_str(), "user.note", "x", 1, 0) == 0;
  REQUIRE(symlink("a", link.c_str()) == 0);
  REQUIRE(replace_text(link, "old", "new").has_value());
  CHECK(read_file(file) == "new");
  CHECK((state_of(file).st_mode & 07777u) == 0640);
  CHECK(std::filesystem::is_symlink(link));
  char note = 0;
  if (has_attributes) CHECK((getxattr(file.c_str(), "user.note", &note, 1) == 1 && note == 'x'));
  CHECK(count_files(directory) == 2);
}

TEST_CASE("a text is replaced, with setuid and setgid, in a new file and in place") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "old");
  REQUIRE(chmod(file.c_str(), 06755) == 0);
  REQUIRE(replace_text(file, "old", "new").has_value());
  CHECK((state_of(file).st_mode & 07777u) == 06755);
  REQUIRE(link(file.c_str(), directory.path("b").c_str()) == 0);
  REQUIRE(replace_text(file, "new", "newer").has_value());
  CHECK((state_of(file).st_mode & 07777u) == 06755);
}

TEST_CASE("a file with several names keeps them") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "a long text"), other = directory.path("b");
  REQUIRE(link(file.c_str(), other.c_str()) == 0);
  REQUIRE(replace_text(file, "a long text", "short").has_value());
  CHECK(read_file(other) == "short");
  CHECK(state_of(file).st_ino == state_of(other).st_ino);
  REQUIRE(replace_text(other, "short", std::string(100'000, 'x')).has_value());
  CHECK(read_file(file) == std::string(100'000, 'x'));
  CHECK(count_files(directory) == 2);
}

TEST_CASE("a text that has changed meanwhile stays") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "saved by somebody");
  const std::string other = directory.file("b", "saved by somebody");
  REQUIRE(link(other.c_str(), directory.path("c").c_str()) == 0);
  for (const std::string& it : {file, other}) {
    for (const std::string expected :
         {"", "saved", "saved by somebody else", "Saved by somebody"}) {
      const auto done = replace_text(it, expected, "new");
      REQUIRE(!done);
      CHECK(done.error().message == "'" + it + "' has changed meanwhile");
      CHECK(read_file(it) == "saved by somebody");
    }
  }
  CHECK(!replace_text(directory.path("gone"), "old", "new"));
  CHECK(count_files(directory) == 3);
}

TEST_CASE("a full disk leaves the old text") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "old"), other = directory.file("b", "old");
  REQUIRE(link(other.c_str(), directory.path("c").c_str()) == 0);
  for (const std::string& it : {file, other}) {
    const auto done = [&] {
      const SmallDisk disk(1000);
      return replace_text(it, "old", std::string(100'000, 'x'));
    }();
    CHECK(!done);
    CHECK(read_file(it) == "old");
  }
  CHECK(count_files(directory) == 3);
}

// The thread that replaces the text waits at a pipe, so a signal to the process comes to another.
TEST_CASE("a signal that ends the process waits, whichever thread it comes to") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("t.xml", "old");
  for (int trial = 0; trial < 50; ++trial) {
    const std::string text(1u << 20, 'x');
    const std::string old = read_file(file);
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGTERM, SIG_DFL);
      std::thread other([] {
        while (true) pause();
      });
      sigset_t all;
      sigfillset(&all);
      pthread_sigmask(SIG_BLOCK, &all, nullptr);
      std::thread killer([] {
        usleep(200);
        kill(getpid(), SIGTERM);
      });
      for (int i = 0; i < 1'000; ++i) {
        const std::string next = i % 2 == 0 ? text : "new";
        if (!replace_text(file, i == 0 ? old : i % 2 == 0 ? "new" : text, next)) _exit(1);
      }
      _exit(2);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    INFO("trial " << trial << ", status " << status);
    CHECK(WIFSIGNALED(status));
    REQUIRE(count_files(directory) == 1);
  }
}

TEST_CASE("what is not a file is not replaced") {
  const TemporaryDirectory directory;
  CHECK(!replace_text(directory.path(""), "", "new"));
  REQUIRE(mkfifo(directory.path("pipe").c_str(), 0600) == 0);
  CHECK(!replace_text(directory.path("pipe"), "", "new"));
}

TEST_CASE("a new text is not written over a file") {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a", "old");
  CHECK(!create_text(file, "new"));
  CHECK(read_file(file) == "old");
  CHECK(create_text(directory.path("b"), "new").has_value());
  CHECK(read_file(directory.path("b")) == "new");
}

}  // namespace lockstep::host::test
