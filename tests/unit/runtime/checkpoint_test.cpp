// The file of checkpoints: what is read is the newest that is whole, whatever a kill or a power cut
// leaves, and nothing else is accepted.
#include "run/checkpoint/checkpoint_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/core/crc32c.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

const CheckpointFacts kFacts{.identity = {{"the version of lockstep", "1.0.0"}},
                             .nodes = {"Main", "Main/left"},
                             .is_leaf = {0, 1}};

std::string facts_bytes() {
  std::string bytes;
  append_facts(kFacts, bytes);
  return bytes;
}

// The one after so many ticks.
std::string checkpoint_bytes(std::uint64_t ticks, std::size_t size = 500) {
  Checkpoint head;
  head.ticks = ticks;
  std::string bytes;
  append_head(head, bytes);
  return bytes + std::string(size, static_cast<char>(ticks));
}

std::optional<std::uint64_t> ticks_in(const std::string& path) {
  const auto kept = read_checkpoint_file(path);
  if (!kept || !*kept) return std::nullopt;
  return (*kept)->checkpoint.ticks;
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace

TEST_CASE("the checksum of checkpoints is CRC-32C") {
  CHECK(crc32c("123456789") == 0xe3069283);
  CHECK(crc32c("6789", crc32c("12345")) == 0xe3069283);
}

TEST_CASE("a checkpoint file has what was written last") {
  const TemporaryDirectory directory;
  const std::string path = directory.path("run.checkpoint");
  CHECK_FALSE(*read_checkpoint_file(path));
  CheckpointFile file(path);
  REQUIRE(file.begin(facts_bytes(), checkpoint_bytes(0)));
  CHECK(ticks_in(path) == 0);
  for (std::uint64_t ticks = 1; ticks < 20; ++ticks) {
    REQUIRE(file.write(checkpoint_bytes(ticks)));
    if (ticks % 7 == 0) REQUIRE(file.sync());
    CHECK(ticks_in(path) == ticks);
  }
  REQUIRE(file.write(checkpoint_bytes(20, 50'000)));  // it does not fit
  CHECK(ticks_in(path) == 20);
  REQUIRE(file.write(checkpoint_bytes(21)));
  CHECK(ticks_in(path) == 21);
  const auto kept = read_checkpoint_file(path);
  CHECK((*kept)->facts.nodes == kFacts.nodes);
  CHECK((*kept)->facts.identity == kFacts.identity);
  CHECK((*kept)->checkpoint.run == std::string(500, static_cast<char>(21)));
}

TEST_CASE("a torn write costs one checkpoint, and what was synced stays until the next sync") {
  const TemporaryDirectory directory;
  const std::string path = directory.path("run.checkpoint");
  CheckpointFile file(path);
  REQUIRE(file.begin(facts_bytes(), checkpoint_bytes(1)));
  REQUIRE(file.write(checkpoint_bytes(2)));
  REQUIRE(file.sync());
  const std::string synced = read_file(path);
  std::string before = synced;
  std::minstd_rand random(1);
  for (std::uint64_t ticks = 3; ticks < 9; ++ticks) {
    REQUIRE(file.write(checkpoint_bytes(ticks)));
    const std::string after = read_file(path);
    std::size_t first = 0, last = after.size();
    while (first < last && after[first] == before[first]) ++first;
    while (last > first && after[last - 1] == before[last - 1]) --last;
    for (std::size_t torn = first; torn < last; torn += 50) {
      write_bytes(path + ".torn", after.substr(0, torn) + before.substr(torn));
      CHECK(ticks_in(path + ".torn") == ticks - 1);
    }
    // Of the sectors that were written since the sync, a power cut leaves any.
    for (int cut = 0; cut < 20; ++cut) {
      std::string left = synced;
      for (std::size_t sector = 0; sector < left.size(); sector += 256) {
        if (random() % 2 == 0) left.replace(sector, 256, after, sector, 256);
      }
      write_bytes(path + ".left", left);
      CHECK(ticks_in(path + ".left").value_or(0) >= 2);
    }
    before = after;
  }
}

TEST_CASE("a damaged checkpoint is refused or an older one, and never anything else") {
  const TemporaryDirectory directory;
  const std::string path = directory.path("run.checkpoint");
  {
    CheckpointFile file(path);
    REQUIRE(file.begin(facts_bytes(), checkpoint_bytes(1)));
    REQUIRE(file.write(checkpoint_bytes(2)));
  }
  const std::string good = read_file(path);
  const std::string bad = directory.path("bad");
  for (std::size_t at = 0; at < good.size(); at += at < 300 ? 1 : 61) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    write_bytes(bad, bytes);
    const auto ticks = ticks_in(bad);
    CHECK((!ticks || *ticks == 1 || *ticks == 2));
    write_bytes(bad, good.substr(0, at));
    const auto cut = ticks_in(bad);
    CHECK((!cut || *cut == 1 || *cut == 2));
  }
}

TEST_CASE("one run at a time has a checkpoint file, and no other file becomes one") {
  const TemporaryDirectory directory;
  const std::string path = directory.path("run.checkpoint");
  CheckpointFile first(path);
  CHECK(first.error() == "");
  CheckpointFile second(path);
  CHECK(second.error() == "cannot open '" + path + "': another run keeps its checkpoints there");
  CHECK_FALSE(second.begin(facts_bytes(), checkpoint_bytes(1)));
  const std::string diary = directory.file("diary", "dear diary");
  CHECK(CheckpointFile(diary).error() == "cannot open '" + diary + "': it is not a checkpoint");
  CHECK_FALSE(read_checkpoint_file(diary));
  std::filesystem::create_symlink(diary, directory.path("link"));
  CHECK(CheckpointFile(directory.path("link")).error() != "");
  CHECK_FALSE(read_checkpoint_file(directory.path("link")));
  CHECK(CheckpointFile(directory.path("")).error() != "");
  CHECK(CheckpointFile("/dev/null").error() != "");
  mkfifo(directory.path("pipe").c_str(), 0600);
  CHECK(CheckpointFile(directory.path("pipe")).error() != "");
  CHECK_FALSE(read_checkpoint_file(directory.path("pipe")));
}

}  // namespace lockstep::host::test
