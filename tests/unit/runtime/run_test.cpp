// A run that begins anew.
#include "run/run.h"

#include <catch2/catch.hpp>

#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

const lockstep_host& host = host_table();

}  // namespace

TEST_CASE("a run begun anew is as a new one, whatever the one before it left") {
  lab = {};
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
  const Tree tree = lab_tree(*plugins.types().at(0), 2);
  Run run(tree, {.seed = 3});
  const auto first_leaf = [] { return lab.leaves.at(0); };
  double before = -1, after = -1;
  const bool had_value = host.get_double(first_leaf(), kSpeed, &before);
  const std::uint64_t number = host.random_bits(first_leaf());
  REQUIRE(host.set_double(first_leaf(), kSpeed, 42));
  run.set_now(std::chrono::seconds(5));

  lab.events.clear();
  lab.leaves.clear();
  run.restart(3);
  CHECK(lab.events == std::vector<std::string>{"destroy 1", "destroy 0", "destroy run",
                                               "create run", "create 0", "create 1"});
  CHECK(host.get_double(first_leaf(), kSpeed, &after) == had_value);
  CHECK(before == after);
  CHECK(host.now(first_leaf()) == 0);
  CHECK(host.random_bits(first_leaf()) == number);
  CHECK(run.fault() == nullptr);
}

}  // namespace lockstep::host::test
