// The leaf objects of one run, their run contexts, and the host functions they call.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "engine/blackboard.h"
#include "engine/node_context.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// Identifies a thread, without a system call.
inline const void* this_thread_id() {
  static constinit thread_local char id = 0;
  return &id;
}

class BoardsOfRun;
class Workers;
class ProcessLeaves;
class EndBudget;
class TickBudget;
class WakeUp;

// The time of a run as its leaves see it; the owner of the run updates it.
struct LeafTime {
  Nanoseconds now{0};
  Nanoseconds period{0};
  const void* thread = nullptr;  // as this_thread_id: the one that may call the host; null: any
  Workers* workers = nullptr;    // on the virtual clock: threads of leaves take turns
  std::uint32_t turns = 1;       // so often they were given, for who gives them in another process
  ProcessLeaves* processes = nullptr;  // those that are looked at while they are held
  EndBudget* end_budget = nullptr;     // null: each process has its own patience
  WakeUp* wake_up = nullptr;           // null: nobody waits between two ticks
  TickBudget* budget = nullptr;        // null: each that waits in a tick has its own patience
};

// Lines that leaves log: the path of the leaf (or the plugin's name, from create_run), level, text.
// May be called from any thread.
using LeafLog =
    std::function<void(std::string_view who, lockstep_log_level level, std::string_view message)>;

// "debug", "info" or "warning".
constexpr std::string_view name_of(lockstep_log_level level) {
  if (level == LOCKSTEP_LOG_WARNING) return "warning";
  return level == LOCKSTEP_LOG_DEBUG ? "debug" : "info";
}

class LeafSet {
 public:
  // Creates the run context of every plugin in the tree, then every leaf in pre-order. All
  // references must outlive the set. If a leaf cannot be created, fault() has the reason and the
  // set must not be ticked. `seed` and a leaf's place in the tree determine its stream of random
  // numbers.
  LeafSet(const Tree& tree, Blackboard& blackboard, const LeafTime& time, std::uint64_t seed,
          LeafLog log = {}, BoardsOfRun* boards = nullptr);
  // Destroys the leaves in reverse order, then the run contexts. No leaf may be running.
  ~LeafSet();
  // The two halves of a restart, as if the set were made again. In between, the owner resets what
  // the leaves see. The host allocates nothing again.
  void destroy_all();
  void create_all(std::uint64_t seed);

  LeafSet(const LeafSet&) = delete;
  LeafSet& operator=(const LeafSet&) = delete;

  std::span<LeafSlot> slots();
  // Sets the run that ticks them, as node kinds see it. Call before the first tick.
  void set_node_context(NodeContext& context);
  const std::optional<Fault>& fault() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

// The table that this host gives to plugins.
const lockstep_host& host_table();

}  // namespace lockstep::host
