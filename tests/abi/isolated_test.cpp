// Plugins in processes of their own: as long as such a process lives, nobody can tell it from this
// one.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <thread>

#include "abi/support/isolated_leaves.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("isolated: the node types are those of the plugin in this process") {
  PluginSet here, there;
  Diagnostics diagnostics;
  set_isolation(there, Isolation::Isolated);
  REQUIRE(there.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(here.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(here.types().size() == there.types().size());
  const NodeType& one = *here.types()[0];
  const NodeType& other = *there.types()[0];
  CHECK((one.id == other.id && one.category == other.category && one.doc == other.doc));
  CHECK((one.plugin == other.plugin && one.has_progress == other.has_progress));
  REQUIRE(one.parameters.size() == other.parameters.size());
  for (std::size_t port = 0; port < one.parameters.size(); ++port) {
    const Parameter& a = one.parameters[port];
    const Parameter& b = other.parameters[port];
    CHECK((a.name == b.name && a.type == b.type && a.doc == b.doc && a.unit == b.unit));
    CHECK((a.default_text == b.default_text && a.required == b.required));
    CHECK(a.direction == b.direction);
    CHECK((a.range.min == b.range.min && a.range.max == b.range.max));
  }
}

TEST_CASE("isolated: of a plugin with control nodes, those stay, and all else is isolated") {
  const std::string path = LOCKSTEP_BINARY_DIR "/plugins/nav.so";
  PluginSet plugins;
  set_isolation(plugins, Isolation::Isolated);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(path, diagnostics));
  const Strings told = texts(diagnostics);
  REQUIRE(told.size() == 1);
  CHECK(told[0].starts_with("plugin '" + path + "' is isolated only in part: 'RecoveryNode', "));
  CHECK(
      told[0].ends_with(" run in this process | 'RecoveryNode' is a control node; the two parts "
                        "share nothing but ports"));
  PluginSet whole;
  CHECK(whole.load_file(path, diagnostics));
  CHECK(plugins.types().size() == whole.types().size());
  const auto list = plugins.list();
  REQUIRE(list.size() == 2);
  CHECK((list[0].isolated && !list[1].isolated));
  const auto* const isolated = static_cast<const lockstep_plugin*>(plugins.types().front()->origin);
  for (const NodeType* type : plugins.types()) {
    const bool is_leaf =
        type->category == NodeCategory::Action || type->category == NodeCategory::Condition;
    CHECK((type->origin == isolated) == is_leaf);
  }
}

TEST_CASE("isolated: a plugin that carries objects without bytes is refused") {
  const std::string path = plugin_path("carries");
  PluginSet plugins;
  Diagnostics diagnostics;
  CHECK(plugins.load_file(path, diagnostics));
  const Strings refused = refusal(path, Isolation::Isolated);
  REQUIRE(refused.size() == 1);
  CHECK(refused[0] == "plugin '" + path +
                          "' cannot be isolated: the port 'ticks' of 'Probe' carries objects, and "
                          "the type 'nav.Path' has no to_bytes and from_bytes | load it without "
                          "isolation, or give the type both functions");
}

TEST_CASE("isolated: values of every type go in and out, also large ones") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  CHECK(leaves.tick().empty());
  CHECK(leaves.value(kStringOut).index() == 0);  // nothing came in

  leaves.value(kBoolIn) = true;
  leaves.value(kIntIn) = INT64_MIN;
  leaves.value(kDoubleIn) = -0.125;
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{1} << 20}) {
    std::string text(size, 'a');
    if (size == 3) text[1] = '\0';
    const std::vector<double> list(size, 1.5);
    leaves.value(kStringIn) = text;
    leaves.value(kListIn) = list;
    CHECK(leaves.tick().empty());
    CHECK((leaves.get<std::string>(kStringOut) == text));
    CHECK((leaves.get<std::vector<double>>(kListOut) == list));
  }
  CHECK(leaves.get<bool>(kBoolOut));
  CHECK(leaves.get<std::int64_t>(kIntOut) == INT64_MIN);
  CHECK(leaves.get<double>(kDoubleOut) == -0.125);
}

TEST_CASE("lists and numbers go in and out, in this process and isolated") {
  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    INFO((isolation == Isolation::Isolated));
    Leaves leaves("echo", {{}}, isolation);
    CHECK(leaves.tick().empty());
    CHECK(leaves.value(kStringListOut).index() == 0);
    for (const std::size_t size : {std::size_t{2}, std::size_t{0}, std::size_t{1000}}) {
      const std::vector<std::int64_t> numbers(size, INT64_MIN);
      const std::vector<Flag> flags(size, Flag{true});
      const std::vector<std::string> texts(size, std::string("a\0b", 3));
      leaves.value(kIntListIn) = numbers;
      leaves.value(kBoolListIn) = flags;
      leaves.value(kStringListIn) = texts;
      leaves.value(kNumberIn) = static_cast<std::int64_t>(size);
      CHECK(leaves.tick().empty());
      CHECK(leaves.get<std::vector<std::int64_t>>(kIntListOut) == numbers);
      CHECK((leaves.get<std::vector<Flag>>(kBoolListOut) == flags));
      CHECK(leaves.get<std::vector<std::string>>(kStringListOut) == texts);
      CHECK(leaves.get<double>(kNumberOut) == static_cast<double>(size));
    }
    leaves.value(kNumberIn) = 0.5;
    CHECK(leaves.tick().empty());
    CHECK(leaves.get<double>(kNumberOut) == 0.5);
    leaves.value(kNumberIn) = std::int64_t{-2};
    CHECK(leaves.tick() ==
          "-2 is outside the range of 'number_in': 'number_in' is '-2', from the entry "
          "'{number_in}'; it must be from -1 to 1000");
    CHECK(leaves.get<double>(kNumberOut) == 0.5);
  }
}

TEST_CASE("isolated: values that are too large are an error, and the process lives on") {
  Leaves leaves("echo", {{}});
  const std::string error =
      "the values of its ports are larger than the 64 MiB that an isolated plugin can exchange in "
      "a call";
  leaves.value(kStringIn) = std::string(std::size_t{65} << 20, 'x');
  CHECK(leaves.tick() == error);
  leaves.value(kStringIn) = std::string("small");
  leaves.value(kGrow) = std::int64_t{65} << 20;
  CHECK(leaves.tick() == error);
  leaves.value(kGrow) = std::int64_t{0};
  CHECK(leaves.tick().empty());
  CHECK(leaves.get<std::string>(kStringOut) == "small");
}

TEST_CASE("isolated: ports of one entry are one, for a leaf and between leaves") {
  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    INFO((isolation == Isolation::Isolated));
    PluginSet plugins;
    set_isolation(plugins, isolation);
    Diagnostics diagnostics;
    REQUIRE(plugins.load_file(plugin_path("echo"), diagnostics));
    REQUIRE(plugins.initialize(diagnostics));
    Tree tree = leaves_of(*plugins.types().at(0), {{}, {}});
    // The first leaf's output is its own input, and what the second one copies.
    tree.ports[kStringOut].slot = kStringIn;
    tree.ports[kGrow].slot = kSeen;
    Blackboard blackboard(tree);
    const LeafTime time;
    LeafSet set(tree, blackboard, time, 1);
    const auto tick = [&](std::size_t leaf) {
      const LeafSlot& slot = set.slots()[leaf];
      slot.type->tick(slot.self);
      CHECK(slot.error == nullptr);
    };
    blackboard.entries[kStringIn].assign(std::string("ab"));
    tick(0);  // sees a size of 2, and then sets a string of that size
    CHECK(std::get<std::string>(blackboard.entries[kStringIn].value()) == "xx");
    CHECK(std::get<std::int64_t>(blackboard.entries[kSeen].value()) == 2);
    tick(1);
    CHECK(std::get<std::string>(blackboard.entries[kStringOut].value()) == "xx");
  }
}

TEST_CASE("isolated: the same random numbers, at the same time") {
  const auto numbers = [](Isolation isolation) {
    Leaves leaves("echo", {{}, {}}, isolation);
    std::vector<double> result;
    for (const std::size_t leaf : {0, 1, 1, 0}) {
      leaves.time.now += std::chrono::seconds(1);
      leaves.tick(leaf);
      result.push_back(leaves.get<double>(kRandom));
    }
    return result;
  };
  CHECK(numbers(Isolation::Isolated) == numbers(Isolation::InProcess));
}

TEST_CASE("isolated: a line from another thread of the plugin arrives by itself") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  leaves.value(kSpeak) = true;
  CHECK(leaves.tick().empty());
  std::unique_lock lock(leaves.mutex);
  const bool arrived =
      leaves.logged.wait_for(lock, std::chrono::seconds(20), [&] { return !leaves.log.empty(); });
  REQUIRE(arrived);
  CHECK(leaves.log == Strings{"Test/leaf0: from another thread"});
}

TEST_CASE("isolated: runs at the same time have processes of their own") {
  const NothingRemains nothing_remains;
  PluginSet plugins;
  set_isolation(plugins, Isolation::Isolated);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(plugins.initialize(diagnostics));
  const Tree tree = leaves_of(*plugins.types().at(0), {{}});
  std::int64_t processes[2] = {};
  std::mutex mutex;
  std::condition_variable changed;
  int running = 0;
  std::vector<std::thread> threads;
  for (std::int64_t& process : processes) {
    threads.emplace_back([&] {
      Blackboard blackboard(tree);
      const LeafTime time;
      LeafSet set(tree, blackboard, time, 1);
      {
        std::unique_lock lock(mutex);
        ++running;
        changed.notify_all();
        changed.wait(lock, [&] { return running == 2; });
      }
      const LeafSlot& slot = set.slots()[0];
      for (int tick = 0; tick < 100; ++tick) slot.type->tick(slot.self);
      process = std::get<std::int64_t>(blackboard.entries[kProcess].value());
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(processes[0] > 0);
  CHECK(processes[1] > 0);
  CHECK(processes[0] != processes[1]);
}

TEST_CASE("isolated: a run ends in order when the process of its leaf dies") {
  const NothingRemains nothing_remains;
  PluginSet plugins;
  set_isolation(plugins, Isolation::Isolated);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("crash"), diagnostics));
  REQUIRE(plugins.initialize(diagnostics));
  const Tree tree = leaves_of(*plugins.types().at(0), {crash_in("tick", "abort")});
  Run run(tree, {});
  run.tick(Nanoseconds(0));
  REQUIRE(run.fault() != nullptr);
  CHECK(run.fault()->message == "its process was killed by SIGABRT (Aborted)");
  run.restart(1);
  CHECK(run.fault() == nullptr);
}

}  // namespace
}  // namespace lockstep::host::test
