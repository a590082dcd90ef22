// Files that a user names to be written anew: when they get their name, and what they never touch.
#include "base/system/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/system/descriptors.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

class Directory {
 public:
  Directory() {
    std::string pattern = (fs::temp_directory_path() / "lockstep-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Directory() { fs::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name) << text;
    return *this / name;
  }

 private:
  std::string path_;
};

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST_CASE("output file: the old file stays until the new one takes its name") {
  const Directory directory;
  const std::string path = directory.file("out", "old\n");
  {
    const OutputFile unused(path);
    CHECK(write_all(unused.descriptor(), "half"));
  }
  CHECK(text_of(path) == "old\n");
  CHECK(directory.entries() == 1);
  {
    OutputFile out(path);
    CHECK(write_all(out.descriptor(), "new\n"));
    CHECK(text_of(path) == "old\n");
    CHECK(out.take_name());
    CHECK(text_of(path) == "new\n");
    CHECK(write_all(out.descriptor(), "more\n"));
  }
  CHECK(text_of(path) == "new\nmore\n");
  CHECK(directory.entries() == 1);
}

TEST_CASE("output file: what a killed process leaves has no name") {
  const Directory directory;
  for (const bool is_there : {false, true}) {
    if (is_there) directory.file("out", "old\n");
    OutputFile out(directory / "out");
    CHECK(write_all(out.descriptor(), "half"));
    CHECK(directory.entries() == std::size_t{is_there});
  }
}

TEST_CASE("output file: as the umask says") {
  const Directory directory;
  const mode_t before = umask(027);
  REQUIRE(write_output(directory / "out", "x").has_value());
  umask(before);
  CHECK(fs::status(directory / "out").permissions() == fs::perms(0640));
}

TEST_CASE("output file: the new file has the mode of the old one") {
  const Directory directory;
  const std::string path = directory.file("out", "old\n");
  fs::permissions(path, fs::perms(0604));
  REQUIRE(write_output(path, "new\n").has_value());
  CHECK(text_of(path) == "new\n");
  CHECK(fs::status(path).permissions() == fs::perms(0604));
  CHECK(directory.entries() == 1);
}

TEST_CASE("output file: a link is not followed, whether it leads to a file or nowhere") {
  const Directory directory;
  const std::string victim = directory.file("victim", "precious\n");
  fs::create_symlink(victim, directory / "link");
  fs::create_symlink(directory / "nowhere", directory / "dangling");
  for (const std::string name : {"link", "dangling"}) {
    const OutputFile out(directory / name);
    CHECK(out.descriptor() < 0);
    CHECK(out.error() ==
          "cannot open '" + (directory / name) + "': it is a symbolic link; name the file itself");
  }
  CHECK(text_of(victim) == "precious\n");
  CHECK_FALSE(fs::exists(directory / "nowhere"));
}

TEST_CASE("output file: a link that appears meanwhile is replaced, not followed") {
  const Directory directory;
  const std::string victim = directory.file("victim", "precious\n");
  OutputFile out(directory / "out");
  fs::create_symlink(victim, directory / "out");
  CHECK(write_all(out.descriptor(), "new\n"));
  CHECK(out.take_name());
  CHECK(text_of(victim) == "precious\n");
  CHECK_FALSE(fs::is_symlink(directory / "out"));
}

TEST_CASE("output file: temporary names that are taken, by files or links, are passed over") {
  const Directory directory;
  const std::string victim = directory.file("victim", "precious\n");
  const std::string own = directory / ("out." + std::to_string(getpid()) + "-");
  for (const std::string attempt : {"0", "1", "2"}) {
    fs::create_symlink(victim, own + attempt + ".new");
  }
  for (const std::string text : {"new\n", "newer\n"}) {
    REQUIRE(write_output(directory / "out", text).has_value());
    CHECK(text_of(directory / "out") == text);
  }
  CHECK(directory.entries() == 5);
  CHECK(text_of(victim) == "precious\n");
}

TEST_CASE("output file: pipes and devices are written to as they are, by any link") {
  const Directory directory;
  REQUIRE(mkfifo((directory / "pipe").c_str(), 0600) == 0);
  const int reader = open((directory / "pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  fs::create_symlink(directory / "pipe", directory / "link");
  fs::create_symlink("/dev/null", directory / "null");
  for (const std::string name : {"pipe", "link", "null"}) {
    OutputFile out(directory / name);
    CHECK(out.error().empty());
    CHECK(write_all(out.descriptor(), "x"));
    CHECK(out.take_name());
  }
  char bytes[3];
  CHECK(read(reader, bytes, sizeof bytes) == 2);
  CHECK(fs::is_fifo(directory / "pipe"));
  CHECK(directory.entries() == 3);
  close(reader);
}

TEST_CASE("output file: says why it cannot be opened") {
  const Directory directory;
  CHECK(OutputFile("/nowhere/out").error() ==
        "cannot open '/nowhere/out': No such file or directory");
  CHECK(OutputFile("").error() == "cannot open '': No such file or directory");
  CHECK(OutputFile(directory / "").error() ==
        "cannot open '" + (directory / "") + "': Is a directory");
  CHECK(directory.entries() == 0);
}

TEST_CASE("output file: a name as long as the system takes") {
  const Directory directory;
  const std::string path = directory / std::string(255, 'n');
  OutputFile out(path);
  CHECK(write_all(out.descriptor(), "x"));
  CHECK(out.take_name());
  CHECK(text_of(path) == "x");
}

TEST_CASE("the same file under many names") {
  const Directory directory;
  const std::string path = directory.file("file", "x");
  directory.file("other", "x");
  fs::create_hard_link(path, directory / "hard");
  fs::create_symlink("file", directory / "soft");
  CHECK(is_same_file(path, path));
  CHECK(is_same_file(path, directory / "./file"));
  CHECK(is_same_file(path, directory / "hard"));
  CHECK(is_same_file(directory / "soft", directory / "hard"));
  CHECK_FALSE(is_same_file(path, directory / "other"));
  CHECK_FALSE(is_same_file(path, directory / "nothing"));
  CHECK_FALSE(is_same_file(directory / "nothing", directory / "nothing"));
}

}  // namespace
}  // namespace lockstep::host
