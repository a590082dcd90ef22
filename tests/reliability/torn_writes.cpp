// What a power failure leaves of a checkpoint file: of the writes since the last sync any part, in
// any order. Each image is read as `run --resume` reads it, and must have a checkpoint that is no
// older than the last one that was synced. Usage: torn_writes FOLDER IMAGES
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "run/checkpoint/checkpoint_file.h"

namespace {

using namespace lockstep::host;

// What was done with the files, in order. The writer does it through the functions below, which
// take the place of libc's.
struct Step {
  enum class What : std::uint8_t { Write, Size, Sync, Name } what;
  int file = -1;
  std::uint64_t place = 0;
  std::string bytes = {};
};
std::vector<Step> g_steps;

}  // namespace

extern "C" ssize_t pwrite(int file, const void* bytes, size_t size, off_t place) {
  g_steps.push_back({Step::What::Write, file, static_cast<std::uint64_t>(place),
                     std::string(static_cast<const char*>(bytes), size)});
  return syscall(SYS_pwrite64, file, bytes, size, place);
}

extern "C" int posix_fallocate(int file, off_t place, off_t size) {
  g_steps.push_back({Step::What::Size, file, static_cast<std::uint64_t>(place + size)});
  return ftruncate(file, place + size) == 0 ? 0 : EIO;
}

extern "C" int fdatasync(int file) {
  g_steps.push_back({Step::What::Sync, file});
  return static_cast<int>(syscall(SYS_fdatasync, file));
}

// The file that was synced last takes the name of the checkpoint.
extern "C" int rename(const char* from, const char* to) {
  g_steps.push_back({Step::What::Name});
  return static_cast<int>(syscall(SYS_rename, from, to));
}

namespace {

std::string checkpoint_bytes(std::uint64_t number, std::size_t size) {
  std::string bytes;
  Checkpoint head;
  head.ticks = number;
  append_head(head, bytes);
  return bytes.append(size, static_cast<char>(number));
}

// A long run: most states have about the same size, some outgrow their slot.
struct Life {
  std::vector<std::pair<std::size_t, std::uint64_t>>
      synced;  // after so many steps, the checkpoint that cannot be lost
  std::uint64_t last = 0;

  bool live(const std::string& path, std::mt19937_64& random) {
    CheckpointFile file(path);
    std::string facts;
    append_facts({}, facts);
    if (!file.begin(facts, checkpoint_bytes(1, 500))) return false;
    last = 1;
    synced.emplace_back(g_steps.size(), last);
    std::size_t size = 500;
    for (std::uint64_t number = 2; number < 400; ++number) {
      if (random() % 40 == 0) size += random() % 9000;
      const std::size_t before = g_steps.size();
      if (!file.write(checkpoint_bytes(number, size + random() % 50))) return false;
      last = number;
      // A file with larger slots is synced before it takes the name.
      for (std::size_t i = before; i < g_steps.size(); ++i) {
        if (g_steps[i].what == Step::What::Name) synced.emplace_back(i + 1, number);
      }
      if (random() % 3 == 0) {
        if (!file.sync()) return false;
        synced.emplace_back(g_steps.size(), number);
      }
    }
    return true;
  }
};

void write_into(std::string& image, const Step& step, std::size_t from, std::size_t to) {
  if (image.size() < step.place + to) image.resize(step.place + to);
  step.bytes.copy(image.data() + step.place + from, to - from, from);
}

// The file with the name, when the power fails after so many steps: all that was synced, and of the
// rest some sectors.
std::string image_after(std::size_t steps, std::mt19937_64& random) {
  int named = -1, synced = -1;
  for (std::size_t i = 0; i < steps; ++i) {
    if (g_steps[i].what == Step::What::Sync) synced = g_steps[i].file;
    if (g_steps[i].what == Step::What::Name) named = synced;
  }
  // A descriptor may be used again: the file begins where its space is reserved.
  std::size_t begin = 0, safe = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    if (g_steps[i].what == Step::What::Size && g_steps[i].file == named) begin = i;
    if (g_steps[i].what == Step::What::Sync && g_steps[i].file == named) safe = i;
  }
  constexpr std::size_t kSector = 512;
  std::string image(g_steps[begin].place, '\0');
  std::vector<std::pair<std::size_t, std::size_t>> loose;  // a step, and a place in its bytes
  for (std::size_t i = begin; i < steps; ++i) {
    const Step& step = g_steps[i];
    if (step.what != Step::What::Write || step.file != named) continue;
    if (i < safe) {
      write_into(image, step, 0, step.bytes.size());
      continue;
    }
    for (std::size_t at = 0; at < step.bytes.size(); at += kSector) loose.emplace_back(i, at);
  }
  std::shuffle(loose.begin(), loose.end(), random);
  loose.resize(random() % (loose.size() + 1));
  for (const auto& [step, at] : loose) {
    const std::size_t end = std::min(at + kSector, g_steps[step].bytes.size());
    write_into(image, g_steps[step], at, random() % 10 == 0 ? at + random() % (end - at + 1) : end);
  }
  return image;
}

int fail(const std::string& why) {
  std::fprintf(stderr, "%s\n", why.c_str());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  const std::string folder = arguments[1], path = folder + "/run.checkpoint",
                    cut = folder + "/cut.checkpoint";
  const long images = std::atol(arguments[2]);
  std::mt19937_64 random(1);
  std::ofstream{path};  // so that the first file takes a name that is there
  Life life;
  if (!life.live(path, random)) return fail("the file cannot be written");
  const std::size_t first = life.synced.front().first;
  std::map<std::uint64_t, long> behind;  // how often so many checkpoints are lost
  for (long image = 0; image < images; ++image) {
    const std::size_t steps = first + random() % (g_steps.size() - first);
    std::ofstream(cut, std::ios::trunc | std::ios::binary) << image_after(steps, random);
    std::uint64_t least = 0;
    for (const auto& [after, number] : life.synced) {
      if (after <= steps) least = number;
    }
    const auto kept = read_checkpoint_file(cut);
    if (!kept || !*kept)
      return fail(fmt::format("image {}: {}", image, kept ? "none" : kept.error().message));
    const std::uint64_t found = (*kept)->checkpoint.ticks;
    if (found < least)
      return fail(fmt::format("image {}: checkpoint {}, but {} was synced", image, found, least));
    const std::string& run = (*kept)->checkpoint.run;
    if (run.find_first_not_of(static_cast<char>(found)) != run.npos)
      return fail("the bytes of two checkpoints are mixed");
    ++behind[found - least];
  }
  for (const auto& [more, times] : behind)
    std::printf("%ld times %llu newer than the synced one\n", times,
                static_cast<unsigned long long>(more));
  return 0;
}
