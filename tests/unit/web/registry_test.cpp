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

TEST_CASE("a run does not wait for one with its process number that has the file") {
  const test::TemporaryDirectory directory;
  REQUIRE(setenv("XDG_RUNTIME_DIR", directory.path("").c_str(), 1) == 0);
  Registration first("first.xml", "");
  first.set_link("http://127.0.0.1:1");
  const Registration second("second.xml", "");
  CHECK(first.is_listed());
  CHECK(!second.is_listed());
  REQUIRE(registered_runs().size() == 1);
  CHECK(registered_runs().front().link == "http://127.0.0.1:1");
}
