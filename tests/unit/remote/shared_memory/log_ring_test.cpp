// Lines go through the ring whole, in order, however often it wraps; those that do not fit are
// counted; and nothing that stands in it can harm its reader.
#include "leaves/remote/shared_memory/log_ring.h"

#include <catch2/catch.hpp>
#include <memory>
#include <thread>
#include <vector>

#include "base/core/random.h"

namespace lockstep::host::test {
namespace {

struct RingFixture {
  std::unique_ptr<LogRing> ring = std::make_unique<LogRing>();
  LogRingWriter writer{*ring};
  LogRingReader reader{*ring};
  std::vector<std::string> drain(std::size_t most = 1'000'000) {
    std::vector<std::string> lines;
    reader.drain(
        [&](std::uint32_t caller, lockstep_log_level level, const char* text) {
          lines.push_back(std::to_string(caller) + " " + std::to_string(level) + " " + text);
        },
        most);
    return lines;
  }
};

TEST_CASE("log ring: lines come out as they went in, also where it wraps") {
  RingFixture it;
  for (std::uint32_t line = 0; line < 1000; ++line) {
    const std::string text(line % 997, static_cast<char>('a' + line % 26));
    it.writer.append(line, 1, text);
    REQUIRE(it.drain() == std::vector{std::to_string(line) + " 1 " + text});
  }
  CHECK(it.reader.take_lost() == 0);
  CHECK(it.reader.empty());
}

TEST_CASE("log ring: what does not fit is counted, and nothing else is lost") {
  RingFixture it;
  const std::string text(1000, 'x');
  std::uint32_t written = 0;
  bool called = false;
  while (!called) called = it.writer.append(written++, 0, text);  // more than half full
  CHECK(written > LogRing::kSize / 2 / (text.size() + 16));
  while (it.ring->lost.load() == 0) it.writer.append(written++, 0, text);
  it.writer.append(written, 0, text);
  CHECK(it.drain().size() == written - 1);
  CHECK(it.reader.take_lost() == 2);
  CHECK(it.reader.take_lost() == 0);
}

TEST_CASE("log ring: as many lines come out as are asked for, the others later") {
  RingFixture it;
  for (std::uint32_t line = 0; line < 5; ++line) it.writer.append(line, 1, "x");
  CHECK(it.drain(2) == std::vector<std::string>{"0 1 x", "1 1 x"});
  CHECK_FALSE(it.reader.empty());
  CHECK(it.drain(3) == std::vector<std::string>{"2 1 x", "3 1 x", "4 1 x"});
  CHECK(it.reader.empty());
}

TEST_CASE("log ring: a long line is cut") {
  RingFixture it;
  it.writer.append(0, 0, std::string(1 << 20, 'x'));
  const auto lines = it.drain();
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].size() == (1 << 15) + 4);
}

TEST_CASE("log ring: many writers do not mix their lines") {
  RingFixture it;
  std::vector<std::thread> writers;
  for (std::uint32_t writer = 0; writer < 4; ++writer) {
    writers.emplace_back([&it, writer] {
      for (int line = 0; line < 200; ++line) it.writer.append(writer, 0, std::string(50, 'x'));
    });
  }
  std::size_t count = 0;
  const auto take = [&] {
    for (const std::string& line : it.drain()) {
      ++count;
      CHECK(line.substr(1) == " 0 " + std::string(50, 'x'));
    }
  };
  while (count < 400) take();
  for (std::thread& writer : writers) writer.join();
  take();
  CHECK(count == 800);
}

TEST_CASE("log ring: nonsense is skipped") {
  RandomStream random(2, 2);
  for (int round = 0; round < 200; ++round) {
    RingFixture it;
    for (std::byte& byte : it.ring->bytes) byte = static_cast<std::byte>(random.next());
    it.ring->written.store(random.next() >> (random.next() % 64));
    it.drain();
    CHECK(it.reader.empty());
    it.writer.append(1, 2, "after");
    const auto lines = it.drain();
    CHECK(lines == std::vector<std::string>{"1 2 after"});
  }
}

}  // namespace
}  // namespace lockstep::host::test
