// What the program does before main, it does for every command.
#include <catch2/catch.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "support/paths.h"

namespace lockstep::host::test {

// Valgrind computes them with too few digits: the library of distributions takes that for an error
// and ends the process.
TEST_CASE("the program computes no long doubles before main") {
  const std::string command = "nm -C '" LOCKSTEP_BINARY_DIR "/lockstep'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nm(popen(command.c_str(), "r"), pclose);
  REQUIRE(nm != nullptr);
  std::size_t symbols = 0;
  char line[65536];
  while (std::fgets(line, sizeof line, nm.get()) != nullptr) {
    const std::string text = line;
    ++symbols;
    const bool is_initializer = text.find("_initializer<long double") != text.npos;
    if (is_initializer) FAIL_CHECK(text);
  }
  CHECK(symbols > 100);
}

}  // namespace lockstep::host::test
