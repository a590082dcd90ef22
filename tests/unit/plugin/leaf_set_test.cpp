// The leaves of a run: their lives, and what the host does for them.
#include "leaves/plugin/contract/leaf_set.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "base/core/random.h"
#include "unit/plugin/lab_plugin.h"

namespace lockstep::host::test {
namespace {

using Strings = std::vector<std::string>;

// A set of Lab leaves, called as the leaves would call.
struct Fixture {
  explicit Fixture(std::uint32_t leaves = 1, std::uint64_t seed = 7) {
    Diagnostics diagnostics;
    REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
    tree = lab_tree(*plugins.types().at(0), leaves);
    blackboard.emplace(tree);
    lab.events.clear();
    lab.leaves.clear();
    set.emplace(
        tree, *blackboard, time, seed,
        [this](std::string_view who, lockstep_log_level level, std::string_view text) {
          log.push_back(std::string(who) + " " + std::to_string(level) + " " + std::string(text));
        });
  }
  const lockstep_caller* leaf(std::size_t index = 0) const { return lab.leaves.at(index); }

  PluginSet plugins;
  Tree tree;
  std::optional<Blackboard> blackboard;
  LeafTime time{std::chrono::milliseconds(1500), std::chrono::milliseconds(10)};
  Strings log;
  std::optional<LeafSet> set;
};

const lockstep_host& host = host_table();

TEST_CASE("leaves live within the context of their run, and go in reverse") {
  lab = {};
  Fixture fixture(3);
  CHECK_FALSE(fixture.set->fault());
  CHECK(fixture.set->slots().size() == 3);
  fixture.set.reset();
  CHECK(lab.events == Strings{"create run", "create 0", "create 1", "create 2", "destroy 2",
                              "destroy 1", "destroy 0", "destroy run"});
}

TEST_CASE("a set that begins anew is as if it was made again, with the seed that is given") {
  lab = {};
  Fixture fixture(2);
  const std::uint64_t number = host.random_bits(fixture.leaf(1));
  fixture.set->destroy_all();
  lab.events.clear();
  lab.leaves.clear();
  fixture.set->create_all(7);
  CHECK(lab.events == Strings{"create run", "create 0", "create 1"});
  CHECK(host.random_bits(fixture.leaf(1)) == number);
  fixture.set->destroy_all();
  lab.leaves.clear();
  fixture.set->create_all(8);
  CHECK(host.random_bits(fixture.leaf(1)) != number);
}

TEST_CASE("a leaf has one name for all threads, whichever asks first") {
  lab = {};
  const Fixture fixture;
  const auto& place = *static_cast<const lockstep_place*>(host.get_extension(LOCKSTEP_PLACE));
  std::vector<const char*> names(4);
  std::vector<std::thread> threads;
  for (const char*& name : names) {
    threads.emplace_back([&, leaf = fixture.leaf()] { name = place.name(leaf); });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(names == std::vector(4, names[0]));
  CHECK(names[0] == std::string(fixture.tree.labels[fixture.tree.leaves[0].node].name));
  CHECK(place.child_name(fixture.leaf(), 0) == nullptr);
  CHECK(place.path(fixture.leaf()) == fixture.tree.path(fixture.tree.leaves[0].node));
}

TEST_CASE("a set that could not be made may be made again") {
  lab = {};
  lab.leaf_that_fails = 1;
  Fixture fixture(2);
  REQUIRE(fixture.set->fault());
  fixture.set->destroy_all();
  lab = {};
  fixture.set->create_all(7);
  CHECK_FALSE(fixture.set->fault());
  CHECK(lab.events == Strings{"create run", "create 0", "create 1"});
}

TEST_CASE("after a leaf that cannot be created no other is, and those before it are destroyed") {
  lab = {};
  lab.leaf_that_fails = 1;
  Fixture fixture(3);
  REQUIRE(fixture.set->fault());
  CHECK(fixture.set->fault()->node == 2);
  CHECK(fixture.set->fault()->message == "could not be created: no arm");
  fixture.set.reset();
  CHECK(lab.events == Strings{"create run", "create 0", "create 1", "destroy 0", "destroy run"});
}

TEST_CASE("a run context that comes with an error is destroyed, and has no leaves") {
  lab = {};
  lab.run_error = "no world";
  Fixture fixture(1);
  REQUIRE(fixture.set->fault());
  CHECK(fixture.set->fault()->node == 1);
  CHECK(fixture.set->fault()->message ==
        "the run context of plugin 'lab' could not be created: no world");
  fixture.set.reset();
  CHECK(lab.events == Strings{"create run", "destroy run"});
}

TEST_CASE("get reads constants and entries") {
  lab = {};
  const Fixture fixture;
  bool flag = false;
  double speed = 0;
  double limit = 0;
  const char* text = nullptr;
  const double* list = nullptr;
  std::size_t length = 0;
  std::size_t count = 0;
  CHECK((host.get_bool(fixture.leaf(), kFlag, &flag) && flag));
  CHECK((host.get_double(fixture.leaf(), kSpeed, &speed) && speed == 1.5));
  CHECK((host.get_double(fixture.leaf(), kLimit, &limit) && limit == 0.5));
  REQUIRE(host.get_string(fixture.leaf(), kText, &text, &length));
  CHECK(std::string(text) == "hello");
  CHECK(length == 5);
  REQUIRE(host.get_double_list(fixture.leaf(), kList, &list, &count));
  CHECK(std::vector(list, list + count) == std::vector{1.0, 2.0, 3.0});
}

TEST_CASE("get leaves the value alone when there is none to get") {
  lab = {};
  const Fixture fixture;
  std::int64_t count = 77;
  double number = 77;
  CHECK_FALSE(host.get_int(fixture.leaf(), kCount, &count));           // nobody wrote it
  CHECK_FALSE(host.get_int(fixture.leaf(), kSpeed, &count));           // another type
  CHECK_FALSE(host.get_double(fixture.leaf(), kResult, &number));      // not bound
  CHECK_FALSE(host.get_double(fixture.leaf(), kResult + 1, &number));  // no such port
  CHECK_FALSE(host.get_double(fixture.leaf(), UINT32_MAX, &number));
  CHECK_FALSE(host.get_double(lab.run, kSpeed, &number));  // a run has no ports
  CHECK(count == 77);
  CHECK(number == 77);
}

TEST_CASE("a leaf is told where its constants are, and which ports nobody reads") {
  lab = {};
  Fixture fixture;
  const auto& lasting = *static_cast<const lockstep_lasting*>(host.get_extension(LOCKSTEP_LASTING));
  const auto constant = [&](std::uint32_t port, lockstep_type type) {
    return lasting.constant(fixture.leaf(), port, type);
  };
  REQUIRE(constant(kFlag, LOCKSTEP_BOOL) != nullptr);
  CHECK(*static_cast<const bool*>(constant(kFlag, LOCKSTEP_BOOL)));
  REQUIRE(constant(kLimit, LOCKSTEP_DOUBLE) != nullptr);
  CHECK(*static_cast<const double*>(constant(kLimit, LOCKSTEP_DOUBLE)) == 0.5);
  CHECK(constant(kLimit, LOCKSTEP_INT) == nullptr);      // another type
  CHECK(constant(kSpeed, LOCKSTEP_DOUBLE) == nullptr);   // an entry
  CHECK(constant(kText, LOCKSTEP_STRING) == nullptr);    // no number
  CHECK(constant(kResult, LOCKSTEP_DOUBLE) == nullptr);  // not bound
  CHECK(constant(kResult + 1, LOCKSTEP_DOUBLE) == nullptr);
  CHECK(lasting.is_set(fixture.leaf(), kSpeed));
  CHECK_FALSE(lasting.is_set(fixture.leaf(), kResult));
}

TEST_CASE("set writes entries of the port's type, and nothing else") {
  lab = {};
  Fixture fixture(2);
  const auto entries = [&] {
    std::vector<Value> values;
    for (const Entry& entry : fixture.blackboard->entries) values.push_back(entry.value());
    return values;
  };
  const double nan = std::nan("");
  CHECK(host.set_int(fixture.leaf(0), kCount, 3));
  std::int64_t count = 0;
  CHECK((host.get_int(fixture.leaf(1), kCount, &count) && count == 3));
  CHECK(host.set_double(fixture.leaf(), kSpeed, 2.5));
  CHECK(host.set_string(fixture.leaf(), kText, "ab\0c", 4));
  CHECK(host.set_double_list(fixture.leaf(), kList, nullptr, 0));
  const std::vector<Value> expected = {Value(std::int64_t{3}), Value(2.5),
                                       Value(std::string("ab\0c", 4)),
                                       Value(std::vector<double>{})};
  CHECK(entries() == expected);

  CHECK_FALSE(host.set_bool(fixture.leaf(), kFlag, false));      // an input
  CHECK_FALSE(host.set_double(fixture.leaf(), kLimit, 1));       // a constant
  CHECK_FALSE(host.set_double(fixture.leaf(), kResult, 1));      // not bound
  CHECK_FALSE(host.set_double(fixture.leaf(), kCount, 1));       // another type
  CHECK_FALSE(host.set_double(fixture.leaf(), kResult + 1, 1));  // no such port
  CHECK_FALSE(host.set_double(fixture.leaf(), kSpeed, nan));
  CHECK_FALSE(host.set_double_list(fixture.leaf(), kList, &nan, 1));
  CHECK_FALSE(host.set_string(fixture.leaf(), kText, nullptr, 1));
  CHECK_FALSE(host.set_double(lab.run, kSpeed, 1));
  CHECK(entries() == expected);
  for (const Entry& entry : fixture.blackboard->entries) CHECK(entry.writes() == 1);
}

TEST_CASE("a string or list that does not grow stays where it is, even when set to itself") {
  lab = {};
  Fixture fixture;
  const char* text = nullptr;
  const double* list = nullptr;
  std::size_t length = 0;
  REQUIRE(host.get_string(fixture.leaf(), kText, &text, &length));
  REQUIRE(host.get_double_list(fixture.leaf(), kList, &list, &length));
  CHECK(host.set_string(fixture.leaf(), kText, text + 1, 3));
  CHECK(host.set_double_list(fixture.leaf(), kList, list + 1, 2));
  const auto& entries = fixture.blackboard->entries;
  CHECK(std::get<std::string>(entries[2].value()) == "ell");
  CHECK(std::get<std::string>(entries[2].value()).data() == text);
  CHECK(std::get<std::vector<double>>(entries[3].value()) == std::vector{2.0, 3.0});
  CHECK(std::get<std::vector<double>>(entries[3].value()).data() == list);
}

TEST_CASE("set_error keeps a copy of the first message until it is taken") {
  lab = {};
  Fixture fixture;
  LeafSlot& slot = fixture.set->slots()[0];
  char message[] = "first";
  host.set_error(fixture.leaf(), message);
  message[0] = 'X';
  host.set_error(fixture.leaf(), "second");
  CHECK(std::string(slot.error) == "first");
  slot.set_error(nullptr);
  host.set_error(fixture.leaf(), nullptr);
  CHECK(std::string(slot.error) == "unknown error");
}

TEST_CASE("a long error is cut after 500 bytes, between characters, and the rest is counted") {
  lab = {};
  Fixture fixture;
  LeafSlot& slot = fixture.set->slots()[0];
  host.set_error(fixture.leaf(), std::string(500, 'a').c_str());
  CHECK(std::string(slot.error) == std::string(500, 'a'));
  slot.set_error(nullptr);
  host.set_error(fixture.leaf(), std::string(501, 'a').c_str());
  CHECK(std::string(slot.error) == std::string(500, 'a') + " ... (1 more bytes)");
  slot.set_error(nullptr);
  host.set_error(fixture.leaf(), (std::string(499, 'a') + "\u00e9z").c_str());
  CHECK(std::string(slot.error) == std::string(499, 'a') + " ... (3 more bytes)");
}

TEST_CASE("leaves see the time of their run") {
  lab = {};
  Fixture fixture;
  CHECK(host.now(fixture.leaf()) == Approx(1.5));
  CHECK(host.now(lab.run) == Approx(1.5));
  CHECK(host.tick_period(fixture.leaf()) == Approx(0.01));
  fixture.time.now = std::chrono::seconds(2);
  CHECK(host.now(fixture.leaf()) == Approx(2));
}

TEST_CASE("each leaf and each run draws from a stream of its own, given by the seed") {
  lab = {};
  const Fixture fixture(2, 42);
  RandomStream first(42, 1);
  RandomStream second(42, 2);
  CHECK(host.random_bits(fixture.leaf(0)) == first.next());
  CHECK(host.random(fixture.leaf(0)) == first.next_double());
  CHECK(host.random_bits(fixture.leaf(1)) == second.next());
  const std::uint64_t of_run = host.random_bits(lab.run);
  CHECK(of_run != RandomStream(42, 0).next());
  CHECK(of_run != RandomStream(42, 1).next());
  CHECK(of_run != RandomStream(42, 2).next());
}

TEST_CASE("a line in the log says who wrote it, an unknown level is the nearest") {
  lab = {};
  const Fixture fixture(2);
  host.log(fixture.leaf(1), LOCKSTEP_LOG_INFO, "there");
  host.log(lab.run, 99, nullptr);
  CHECK(fixture.log == Strings{"Test/root/lab1 1 there", "lab 2 "});
}

TEST_CASE("runs of one plugin live on several threads") {
  PluginSet plugins;
  Diagnostics diagnostics;
  REQUIRE(plugins.add(lab_plugin(), "lab", diagnostics));
  const Tree tree = lab_tree(*plugins.types().at(0), 8);
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  for (double& sum : sums) {
    threads.emplace_back([&tree, &sum] {
      for (std::uint64_t run = 0; run < 50; ++run) {
        lab = {};
        Blackboard blackboard(tree);
        const LeafTime time;
        const LeafSet set(tree, blackboard, time, run);
        for (const lockstep_caller* leaf : lab.leaves) {
          sum += host.random(leaf);
          host.set_double(leaf, kSpeed, sum);
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(sums[0] > 0);
  CHECK(sums == std::vector(4, sums[0]));
}

}  // namespace
}  // namespace lockstep::host::test
