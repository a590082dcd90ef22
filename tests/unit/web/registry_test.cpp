#include "show/web/registry.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <thread>

#include "support/program.h"

using namespace lockstep::host;

TEST_CASE("a run is listed although somebody lists the runs while it begins") {
  const test::TemporaryDirectory directory;
  REQUIRE(setenv("XDG_RUNTIME_DIR", directory.path("").c_str(), 1) == 0);
  constexpr int kRuns = 5000;
  const std::jthread lister([](const std::stop_token& end) {
    while (!end.stop_requested()) registered_runs();
  });
  for (int i = 0; i < kRuns; ++i) {
    const Registration run("tree.xml", "");
    REQUIRE(registered_runs().size() == 1);
  }
}
