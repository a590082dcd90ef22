#include "support/generated_file.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "support/paths.h"

namespace lockstep::host::test {

std::string project_file(const std::string& name) {
  std::ifstream in(std::string(LOCKSTEP_SOURCE_DIR) + "/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

void check_generated(const std::string& name, const std::string& text) {
  if (std::getenv("LOCKSTEP_GENERATE") != nullptr) {
    std::ofstream(std::string(LOCKSTEP_SOURCE_DIR) + "/" + name) << text;
  }
  INFO(name << " is stale: ./dev generate");
  CHECK((project_file(name) == text));
}

}  // namespace lockstep::host::test
