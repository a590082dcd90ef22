// The file behind a recording: its queue, its errors, and what a crash handler saves of it.
#include "record/write/append_file.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

#include "base/compression/decompressed.h"
#include "record/part_names.h"
#include "unit/recording/blocked_disk.h"

namespace lockstep::host {
namespace {

using test::BlockedDisk;
using test::TemporaryPath;

constexpr std::size_t kQueue = 5000;  // bytes; packets do not end where it ends

std::string line(int number) {
  return "line " + std::to_string(number) + "\n";
}

Packet packet(std::string_view text) {
  return {.text = text};
}

std::string lines(int first, int last) {
  std::string all;
  for (int number = first; number < last; ++number) all += line(number);
  return all;
}

// Pushes until the queue is full; the number of the first line that was refused.
int push_until_full(AppendFile& file, int number = 0) {
  while (file.push(packet(line(number)))) ++number;
  return number;
}

TEST_CASE("a line that was pushed is written soon, without anything else happening") {
  const TemporaryPath path;
  AppendFile file(path.path());
  CHECK(file.push(packet("line\n")));
  // A test that waits forever has failed.
  while (path.text().empty()) std::this_thread::yield();
  CHECK(path.text() == "line\n");
}

TEST_CASE("a full queue refuses whole lines, waits for nothing, and goes on when there is room") {
  BlockedDisk disk;
  int refused = 0, next = 0;
  {
    AppendFile file(disk.path(), kQueue);
    refused = push_until_full(file);
    CHECK(lines(0, refused).size() <= kQueue + BlockedDisk::kPage);
    CHECK_FALSE(file.failed());
    disk.unblock();
    file.flush();
    next = push_until_full(file, refused + 1);
  }
  CHECK(refused > 0);
  CHECK(next > refused + 1);
  CHECK(disk.text() == lines(0, refused) + lines(refused + 1, next));
}

TEST_CASE("lines go around the end of the queue") {
  const TemporaryPath path;
  {
    AppendFile file(path.path(), 200);
    for (int number = 0; number < 1000; ++number) {
      if (file.push(packet(line(number)))) continue;
      file.flush();
      REQUIRE(file.push(packet(line(number))));
    }
  }
  CHECK(path.text() == lines(0, 1000));
}

TEST_CASE("write waits, also for lines that are longer than the queue") {
  const TemporaryPath path;
  AppendFile file(path.path(), 100);
  REQUIRE(file.push(packet("1\n")));
  file.write(packet(lines(0, 1000)));
  CHECK(path.text() == "1\n" + lines(0, 1000));
  // The queue is as long as that now.
  CHECK(file.push(packet(lines(0, 1000))));
}

// Files of this process cannot be longer, as on a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_CASE("a file that cannot grow ends after its last whole line") {
  const TemporaryPath path;
  std::string error;
  bool accepted = true;
  {
    AppendFile file(path.path(), kQueue);
    const FileSizeLimit limit(11);  // in the middle of the second line
    file.write(packet(lines(0, 3)));
    error = file.error();
    accepted = file.push(packet(line(3)));
  }
  CHECK(error == "cannot write '" + path.path() + "': File too large");
  CHECK_FALSE(accepted);
  CHECK(path.text() == lines(0, 1));
}

TEST_CASE("a compressed file that has no room for its last bytes reports it when it is completed") {
  const TemporaryPath path;
  AppendFile file(path.path(), kQueue, {.compression = Compression::Zstd});
  file.write(packet(lines(0, 3)));
  CHECK(file.error().empty());
  const FileSizeLimit limit(path.text().size());
  file.end();
  CHECK(file.error() == "cannot write '" + path.path() + "': File too large");
}

TEST_CASE("a file that was emptied by others is not filled up when it is cut back") {
  const TemporaryPath path;
  {
    AppendFile file(path.path(), kQueue);
    file.write(packet(lines(0, 100)));
    REQUIRE(::truncate(path.path().c_str(), 0) == 0);
    const FileSizeLimit limit(11);
    file.write(packet(lines(100, 103)));
  }
  CHECK(path.text() == line(100));
}

// --- compressed ----------------------------------------------------------------------------------

std::string decompressed(const std::string& bytes) {
  std::istringstream in(bytes);
  Decompressed text(*in.rdbuf());
  std::ostringstream all;
  all << &text;
  return std::move(all).str();
}

TEST_CASE("a compressed file has each line when it is flushed, in far fewer bytes") {
  const TemporaryPath path;
  {
    AppendFile file(path.path(), kQueue, {.compression = Compression::Zstd});
    file.write(packet(lines(0, 10)));
    CHECK(decompressed(path.text()) == lines(0, 10));
    file.write(packet(lines(10, 100'000)));  // longer than the queue, and more than a frame
    CHECK(decompressed(path.text()) == lines(0, 100'000));
  }
  CHECK(decompressed(path.text()) == lines(0, 100'000));
  CHECK(path.text().size() * 3 < lines(0, 100'000).size());
}

TEST_CASE("a compressed file that cannot grow can be read up to a whole line") {
  const TemporaryPath path;
  std::string error;
  {
    AppendFile file(path.path(), kQueue, {.compression = Compression::Zstd});
    file.write(packet(lines(0, 100)));
    const FileSizeLimit limit(path.text().size() + 20);
    file.write(packet(lines(100, 1000)));
    error = file.error();
  }
  CHECK(error == "cannot write '" + path.path() + "': File too large");
  CHECK(decompressed(path.text()) == lines(0, 100));
}

// --- emergencies ---------------------------------------------------------------------------------

// What a process does that must not take this one with it; its exit code, or -1.
template <class Function>
int code_of_child(Function function) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(function());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr int kSaved = 42;

void save_and_exit(int) {
  AppendFile::emergency_flush();
  _exit(kSaved);
}

[[noreturn]] void crash() {
  std::signal(SIGSEGV, save_and_exit);
  void* nothing = mmap(nullptr, 1, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  *static_cast<volatile int*>(nothing) = 1;
  _exit(0);
}

TEST_CASE("what was pushed before a crash is in the file") {
  const TemporaryPath path;
  const int code = code_of_child([&]() -> int {
    AppendFile file(path.path());
    file.push(packet(lines(0, 1000)));
    crash();
  });
  CHECK(code == kSaved);
  CHECK(path.text() == lines(0, 1000));
}

TEST_CASE("what was pushed before a crash is in a compressed file, and goes on in its frame") {
  const TemporaryPath path;
  const int code = code_of_child([&]() -> int {
    AppendFile file(path.path(), AppendFile::kQueue, {.compression = Compression::Zstd});
    file.write(packet(lines(0, 1000)));
    file.push(packet(lines(1000, 2000)));
    crash();
  });
  CHECK(code == kSaved);
  CHECK(decompressed(path.text()) == lines(0, 2000));
}

TEST_CASE("a crash handler compresses by itself when the thread does not answer") {
  const TemporaryPath path;
  AppendFile file(path.path(), AppendFile::kQueue, {.compression = Compression::Zstd});
  file.write(packet(lines(0, 10)));
  const int code = code_of_child([&]() -> int {
    file.push(packet(lines(10, 1000)));
    crash();
  });
  CHECK(code == kSaved);
  CHECK(decompressed(path.text()) == lines(0, 1000));
}

TEST_CASE("a crash handler writes by itself when the thread does not answer") {
  const TemporaryPath path;
  AppendFile file(path.path());
  // A fork has the file and its queue, but not the thread.
  const int code = code_of_child([&]() -> int {
    file.push(packet(lines(0, 1000)));
    crash();
  });
  CHECK(code == kSaved);
  CHECK(path.text() == lines(0, 1000));
}

TEST_CASE("a crash handler does not wait forever, not even where it writes by itself") {
  BlockedDisk disk;
  AppendFile file(disk.path());
  CHECK(code_of_child([&]() -> int {
          file.push(packet(lines(0, 2000)));  // more than the pipe takes
          crash();
        }) == kSaved);
}

TEST_CASE("a crash handler does not interfere with a thread that is stuck in a write") {
  BlockedDisk disk;
  AppendFile file(disk.path());
  const std::string all = lines(0, 2000);  // more than the pipe takes
  REQUIRE(file.push(packet(all)));
  const auto begin = std::chrono::steady_clock::now();
  AppendFile::emergency_flush();
  CHECK(std::chrono::steady_clock::now() - begin >= AppendFile::kLongestEmergency);
  disk.unblock();
  file.flush();
  CHECK(file.error() == "");
  CHECK_FALSE(file.failed());
}

TEST_CASE("a part of which the first ticks are lost begins with these") {
  const TemporaryPath path;
  const std::string header = "{\"lockstep_recording\":1,\"x\":0}\n";
  const std::string first = part_name(path.path(), 1), second = part_name(path.path(), 2);
  {
    AppendFile file(path.path(), kQueue, {}, {.are_wanted = true});
    file.set_header(header);
    file.write(packet(header));
    Packet tick = packet("]}\n");
    tick.head = {.lost = 2, .lost_from = 7, .tick = 9};
    tick.head.is_tick = tick.head.begins_part = 1;
    file.write(tick);
  }
  const auto text_of = [](const std::string& name) {
    std::ifstream in(name);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  CHECK(text_of(first) == header + "{\"continued\":{\"ticks\":7}}\n");
  CHECK(text_of(second) ==
        "{\"lockstep_recording\":1,\"first_tick\":7,\"x\":0}\n"
        "{\"lost\":{\"ticks\":2,\"from\":7}}\n"
        "{\"tick\":9,\"time_s\":0.0,\"nodes\":[]}\n");
}

}  // namespace
}  // namespace lockstep::host
