// ctest runs each test case by its name. A name that CMake or Catch2 reads as something else would
// match nothing, and nothing would be tested.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "support/paths.h"

TEST_CASE("every test case has a name that ctest can run") {
  const std::regex kName("TEST_CASE\\(\\s*\"([^\"]*)\"");
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(LOCKSTEP_SOURCE_DIR "/tests")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator it(text.begin(), text.end(), kName), end; it != end; ++it) {
      const std::string name = (*it)[1];
      INFO(entry.path().string() << ": " << name);
      CHECK(name.find_first_of("[];\\*") == std::string::npos);
      CHECK(name.front() != '-');
      CHECK(name.front() != '~');
      ++count;
    }
  }
  CHECK(count > 100);
}
