// Stands in for libFuzzer's main: the first argument is a target, and each file of the folders in
// the other ones is given to it.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

// LOCKSTEP_FUZZ_TARGETS is TARGET(name) for each.
#define TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
LOCKSTEP_FUZZ_TARGETS
#undef TARGET

int main(int argc, char** argv) {
#define TARGET(name) {#name, fuzz_##name},
  const std::map<std::string, decltype(&fuzz_tree)> targets{LOCKSTEP_FUZZ_TARGETS};
#undef TARGET
  int count = 0;
  for (int i = 2; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      targets.at(argv[1])(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
      ++count;
    }
  }
  std::printf("%d files\n", count);
  return count > 0 ? 0 : 1;
}
