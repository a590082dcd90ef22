// Marks of calls, as the thread itself and as another one sees them.
#include "base/system/call_mark.h"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>

#include "leaves/plugin/contract/leaf_set.h"
#include "unit/plugin/probe_plugin.h"

namespace lockstep::host::test {
namespace {

TEST_CASE("functions are called as the contract spells them") {
  CHECK(std::string(name_of(PluginFunction::CreateRun)) == "create_run");
  CHECK(std::string(name_of(PluginFunction::Tick)) == "tick");
  CHECK(std::string(name_of(PluginFunction::Progress)) == "progress");
  CHECK(std::string(name_of(PluginFunction::Deinit)) == "deinit");
}

TEST_CASE("the same words are the same site, for ever") {
  const CallSite& site = CallSite::of({.path = "leaf", .plugin = "plugin"});
  CHECK(&CallSite::of({.path = "leaf", .plugin = "plugin"}) == &site);
  CHECK(&CallSite::of({.path = "leaf", .plugin = "other"}) != &site);
  CHECK(&CallSite::of({.path = "leaf", .id = "Other", .plugin = "plugin"}) != &site);
  CHECK(&CallSite::of_plugin("plugin") != &site);
}

TEST_CASE("a call is marked for as long as it lasts, also when it throws") {
  const CallMark& here = CallMark::this_thread();
  const CallSite& site = CallSite::of({.path = "leaf", .plugin = "plugin"});
  CHECK(here.look().function == PluginFunction::None);
  CallMark::Look first, second;
  try {
    const MarkedCall call(site, PluginFunction::Pause);
    first = here.look();
    throw std::runtime_error("out");
  } catch (const std::runtime_error&) {
    CHECK(here.look().function == PluginFunction::None);
  }
  {
    const MarkedCall call(site, PluginFunction::Pause);
    second = here.look();
  }
  CHECK(first.function == PluginFunction::Pause);
  CHECK(first.site == &site);
  CHECK_FALSE(first == second);  // two calls, though all that is known of them is equal
}

TEST_CASE("each thread has a mark of its own") {
  const MarkedCall call(CallSite::of({.path = "leaf", .plugin = "plugin"}), PluginFunction::Tick);
  PluginFunction of_other = PluginFunction::Load;
  std::thread([&] { of_other = CallMark::this_thread().look().function; }).join();
  CHECK(of_other == PluginFunction::None);
}

TEST_CASE("a look from another thread never mixes two calls") {
  const CallSite& ticked = CallSite::of({.path = "ticked", .plugin = "plugin"});
  const CallSite& halted = CallSite::of({.path = "halted", .plugin = "plugin"});
  std::atomic<const CallMark*> watched{nullptr};
  std::atomic<bool> enough{false};
  std::thread caller([&] {
    watched = &CallMark::this_thread();
    while (!enough) {
      { const MarkedCall call(ticked, PluginFunction::Tick); }
      { const MarkedCall call(halted, PluginFunction::Halt); }
    }
  });
  while (watched == nullptr) std::this_thread::yield();
  int mixed = 0, ticks = 0, halts = 0;
  for (int look = 0; look < 5'000'000 || ticks == 0 || halts == 0; ++look) {
    const CallMark::Look seen = watched.load()->look();
    if (seen.function == PluginFunction::None) continue;
    const bool is_tick = seen.function == PluginFunction::Tick;
    ++(is_tick ? ticks : halts);
    if (seen.site != (is_tick ? &ticked : &halted)) ++mixed;
  }
  enough = true;
  caller.join();
  CHECK(mixed == 0);
}

TEST_CASE("creating and destroying are marked, with a watch and without") {
  const ProbeTree probe(1);
  Blackboard blackboard(probe.tree());
  const LeafTime time;
  std::vector<std::string> seen;
  on_probe_call = [&](PluginFunction function, void*) {
    const CallMark::Look look = CallMark::this_thread().look();
    REQUIRE(look.function == function);
    seen.push_back(std::string(name_of(function)) + " of " + look.site->origin->plugin + ": " +
                   look.site->text());
  };
  { const LeafSet set(probe.tree(), blackboard, time, 1); }
  on_probe_call = nullptr;
  CHECK(seen ==
        std::vector<std::string>{
            "create_run of probe: ", "create of probe: 'Main/leaf0' (Full of plugin 'probe')",
            "destroy of probe: 'Main/leaf0' (Full of plugin 'probe')", "destroy_run of probe: "});
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
}

}  // namespace
}  // namespace lockstep::host::test
