// What a process of lockstep does before its command: it loads few libraries, and defines only the
// options that the command line can have.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <sstream>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kValgrind = "/usr/bin/valgrind";

bool is_sanitized() {
  return std::string(LOCKSTEP_PRELOAD) != "";
}

// In main and what it calls, so without the dynamic linker.
std::uint64_t instructions_of(std::vector<std::string> arguments) {
  std::vector<std::string> all{"--tool=callgrind", "--callgrind-out-file=/dev/null",
                               "--toggle-collect=main", LOCKSTEP_BINARY_DIR "/lockstep"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run({.arguments = all, .program = kValgrind});
  INFO(outcome.err);
  const std::string mark = "Collected : ";
  const auto found = outcome.err.find(mark);
  REQUIRE(found != std::string::npos);
  return std::stoull(outcome.err.substr(found + mark.size()));
}

}  // namespace

TEST_CASE("the program is started with the libraries that each command needs, and no other") {
  if (is_sanitized()) return;
  const std::set<std::string> known{"linux-vdso",  "ld-linux-x86-64", "ld-linux-aarch64", "libc",
                                    "libm",        "libgcc_s",        "libstdc++",        "libfmt",
                                    "libsimdjson", "libtinyxml2",     "libutf8proc",      "libz"};
  const Outcome outcome = run({.arguments = {}, .environment = {{"LD_TRACE_LOADED_OBJECTS", "1"}}});
  std::set<std::string> others;
  for (const std::string& line : lines(outcome.out)) {
    std::istringstream words(line);
    std::string path;
    words >> path;
    const std::string name = std::filesystem::path(path).filename();
    others.insert(name.substr(0, name.find(".so")));
  }
  CHECK(others.contains("libstdc++"));
  for (const std::string& name : known) others.erase(name);
  CHECK(others == std::set<std::string>());
}

TEST_CASE("the options of a command that is not named cost a start nothing") {
  if (is_sanitized() || !std::filesystem::exists(kValgrind)) return;
  const std::uint64_t none = instructions_of({"--version"});
  const std::uint64_t one = instructions_of({"nodes", "Wait"});
  const std::uint64_t all =
      instructions_of({"--no-such-option"});  // whose owner may be any command
  INFO(none << " " << one << " " << all);
  CHECK(none < all / 3);
  CHECK(one < all / 2);
}
