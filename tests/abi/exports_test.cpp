// A plugin that ships exports its entry and nothing else: no symbol of it can meet one of another.
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "support/paths.h"

namespace lockstep::host::test {
namespace {

namespace fs = std::filesystem;

// The names that the dynamic symbol table defines.
std::vector<std::string> exports_of(const fs::path& file) {
  const std::string command = "nm -D --defined-only --format=posix '" + file.string() + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nm(popen(command.c_str(), "r"), pclose);
  REQUIRE(nm != nullptr);
  std::vector<std::string> names;
  char line[4096];
  while (std::fgets(line, sizeof line, nm.get()) != nullptr) {
    const std::string text = line;
    names.push_back(text.substr(0, text.find(' ')));
  }
  return names;
}

TEST_CASE("a shipped plugin exports one symbol") {
  std::size_t plugins = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(LOCKSTEP_BINARY_DIR) / "plugins")) {
    if (entry.path().extension() != ".so") continue;
    ++plugins;
    INFO(entry.path());
    CHECK(exports_of(entry.path()) == std::vector<std::string>{"lockstep_plugin_entry"});
  }
  CHECK(plugins > 0);
}

}  // namespace
}  // namespace lockstep::host::test
