// Leaves of one plugin, in this process or in one of its own, called as the engine would; and a
// look at what may not remain when they are gone.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <condition_variable>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <thread>

#include "abi/plugins/echo_ports.h"  // which are its slots too
#include "abi/support/plugins.h"
#include "run/run.h"

namespace lockstep::host::test {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

constexpr Nanoseconds kShortLimit = std::chrono::milliseconds(200);  // where it is to be reached
constexpr Nanoseconds kLongLimit = std::chrono::seconds(20);

inline std::ptrdiff_t entries_in(const char* directory) {
  return std::distance(fs::directory_iterator(directory), fs::directory_iterator());
}

// What must be as before when everything is over.
struct Belongings {
  std::ptrdiff_t descriptors = entries_in("/proc/self/fd");
  std::ptrdiff_t threads = entries_in("/proc/self/task");
};

inline bool has_child() {
  siginfo_t info{};
  return waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

// Checks at its end that nothing was left behind.
struct NothingRemains {
  // The first thread of a sanitizer's own comes with the first thread of ours.
  NothingRemains() {
    std::thread([] {}).join();
    before = Belongings();
  }
  ~NothingRemains() {
    CHECK_FALSE(has_child());
    // A thread that was joined is listed until the kernel has cleaned up behind it.
    const auto patience = std::chrono::steady_clock::now() + kLongLimit;
    while (Belongings().threads > before.threads && std::chrono::steady_clock::now() < patience) {
      std::this_thread::yield();
    }
    const Belongings after;
    CHECK(after.threads <= before.threads);
    CHECK(after.descriptors == before.descriptors);
  }
  NothingRemains(const NothingRemains&) = delete;
  NothingRemains& operator=(const NothingRemains&) = delete;
  Belongings before;
};

// As many leaves of a type as there are rows; a row gives constants to the first ports, the others
// are bound to the slot of their place. All leaves share the slots. For LeafSet only, unless there
// is one leaf.
inline Tree leaves_of(const NodeType& type, const std::vector<std::vector<Value>>& rows) {
  Tree tree;
  tree.id = "Test";
  for (const Parameter& port : type.parameters) {
    tree.slots.push_back({std::string(port.name), port.type, {}});
  }
  for (const auto& row : rows) {
    const auto node = static_cast<NodeIndex>(tree.nodes.size());
    tree.nodes.push_back(leaf_node(kPluginAction, node));
    static constexpr std::string_view kNames[] = {"leaf0", "leaf1"};
    NodeLabel& label = tree.labels.emplace_back();
    label.name = kNames[node];
    label.type = &type;
    label.parent = node;
    tree.leaves.push_back(LeafNode{node, &type, static_cast<std::uint32_t>(tree.ports.size())});
    for (std::uint32_t port = 0; port < type.parameters.size(); ++port) {
      if (port >= row.size()) {
        tree.ports.push_back(PortBinding{.slot = port});
        continue;
      }
      tree.ports.push_back(
          PortBinding{.constant = static_cast<std::uint32_t>(tree.constants.size())});
      tree.constants.push_back(row[port]);
    }
  }
  return tree;
}

inline std::vector<Value> crash_in(const char* function, const char* how) {
  return {std::string(function), std::string(how)};
}
inline const std::vector<Value> kNoCrash = crash_in("", "");

// Leaves of one plugin, called as the engine would.
struct Leaves {
  Leaves(const std::string& plugin, const std::vector<std::vector<Value>>& rows,
         Isolation isolation = Isolation::Isolated, Nanoseconds hang_limit = kLongLimit) {
    set_isolation(plugins, isolation, hang_limit);
    Diagnostics diagnostics;
    REQUIRE(plugins.load_file(plugin_path(plugin), diagnostics));
    REQUIRE(plugins.initialize(diagnostics));
    tree = leaves_of(*plugins.types().at(0), rows);
    blackboard.emplace(tree);
    set.emplace(tree, *blackboard, time, 7,
                [this](std::string_view who, lockstep_log_level, std::string_view text) {
                  const std::lock_guard lock(mutex);
                  log.push_back(fmt::format("{}: {}", who, text));
                  logged.notify_all();
                });
  }

  // "" or the error that the call has set.
  std::string error_of(std::size_t leaf, void (*function)(LeafSlot&)) {
    LeafSlot& slot = set->slots()[leaf];
    function(slot);
    const char* const error = std::exchange(slot.error, nullptr);
    return error == nullptr ? "" : error;
  }
  std::string tick(std::size_t leaf = 0) {
    return error_of(leaf, [](LeafSlot& slot) { slot.type->tick(slot.self); });
  }
  Value& value(std::size_t slot) { return blackboard->entries[slot].to_write(); }
  template <class T>
  T get(std::size_t slot) {
    return std::get<T>(value(slot));
  }

  PluginSet plugins;
  Tree tree;
  std::optional<Blackboard> blackboard;
  LeafTime time{std::chrono::seconds(2), std::chrono::milliseconds(10)};
  std::mutex mutex;
  std::condition_variable logged;
  Strings log;
  std::optional<LeafSet> set;
};

}  // namespace lockstep::host::test
