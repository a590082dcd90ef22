// The host's side of the functions in lockstep_host: the caller, and what the call may access. Only
// within plugin/. Getters and setters neither lock nor look up a name.
#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/core/node_type.h"
#include "base/core/random.h"
#include "base/core/shortened.h"
#include "base/core/value.h"
#include "engine/leaf_slot.h"
#include "leaves/plugin/contract/bound_port.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "lockstep/ext/changes.h"
#include "lockstep/ext/ticks.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

constexpr std::size_t kLongestLogLine = std::size_t{32} << 10;  // bytes; the rest is cut off

class BoardsOfRun;

// Shared by the callers of a run.
struct CallerRun {
  const LeafLog* log;
  const Tree* tree = nullptr;               // null: its leaves are in no tree
  NodeContext* node_context = nullptr;      // null while leaves are made
  const lockstep_plugin* plugin = nullptr;  // of a run: whose run context it is
  // Collects the entries that are set, for a process that only mirrors them; null: not collected.
  std::vector<Entry*>* written = nullptr;
  BoardsOfRun* boards = nullptr;  // null: nobody uses entries by their names
  EntriesLock* lock = nullptr;    // Blackboard::lock

  // A value that a leaf sets goes into its entry, and nothing else has to be done.
  bool sets_plainly() const { return written == nullptr && lock == nullptr; }
};

// Texts of a node that end with a NUL.
struct NodeTexts {
  struct Child {
    std::string id, name;
  };
  std::string name = {};
  std::vector<Child> children = {};
};

// Texts that any thread makes when it wants them; the first that were made stay.
class TextsOnDemand {
 public:
  TextsOnDemand() = default;
  TextsOnDemand(TextsOnDemand&& from) noexcept : texts_(from.texts_.exchange(nullptr)) {}
  ~TextsOnDemand() { delete texts_.load(); }
  const NodeTexts* get() const { return texts_.load(std::memory_order_acquire); }
  const NodeTexts& set(NodeTexts texts);

 private:
  std::atomic<const NodeTexts*> texts_ = nullptr;
};

// The members that few callers need.
struct CallerRest {
  Shortened error = {};                // the last
  Shortened reason = {};               // the last, of a leaf in another process than the engine
  PortTable ports = {};                // all, when some were opened: those are the last
  std::list<std::string> opened = {};  // their keys
};

}  // namespace lockstep::host

// A leaf of a run, or (without ports) a run itself. What most calls need comes first.
struct lockstep_caller {
  const lockstep::host::LeafTime* time;
  const lockstep::host::Value* const* ordinary = nullptr;  // of each port: BoundPort::ordinary
  std::span<lockstep::host::BoundPort* const> ports = {};
  lockstep::host::RandomStream random;
  lockstep::host::LeafSlot* slot;  // set_error sets its `error`
  const lockstep::host::CallerRun* run;
  const char* who = "";                            // its path, or the plugin's name
  const lockstep::host::NodeType* type = nullptr;  // null: it is a run
  lockstep::host::NodeIndex node = 0;              // in the tree of its run
  std::uint32_t first_child = 0, children = 0;     // of a control node or decorator: in the tree
  std::unique_ptr<lockstep::host::CallerRest> rest = {};
  lockstep::host::TextsOnDemand texts = {};

  lockstep_caller(const lockstep::host::LeafTime& run_time, lockstep::host::LeafSlot& own_slot,
                  const lockstep::host::CallerRun& own_run)
      : time(&run_time), random(0, 0), slot(&own_slot), run(&own_run) {}

  // The calling thread is not the run's: it may only call log, so that it finds nothing to read or
  // to change while a tick goes on.
  bool is_foreign() const {
    const void* const owner = time->thread;
    return owner != lockstep::host::this_thread_id() && owner != nullptr;
  }
  // The child of a control node.
  lockstep::host::NodeIndex child(std::uint32_t index) const {
    return run->tree->children[first_child + index];
  }
};

namespace lockstep::host {

// The contract hands out constant callers, so that plugins keep their hands off.
inline lockstep_caller& mine(const lockstep_caller* caller) {
  return const_cast<lockstep_caller&>(*caller);  // NOLINT: every caller is made non-constant
}

// Sets an error whose message is short enough. The first error of a call is kept.
void take_error(const lockstep_caller& caller, const Shortened& message);

// The getters and setters of the table use these for a port of any type but Object. The value is
// null when there is none that the leaf may read.
const Value* read_port(const lockstep_caller& caller, std::uint32_t port);
bool write_port(const lockstep_caller& caller, std::uint32_t port, const Value& value);

// Null for another thread than the run's, and where there is no such port.
inline BoundPort* port_of(const lockstep_caller& caller, std::uint32_t port) {
  if (caller.is_foreign() || port >= caller.ports.size()) [[unlikely]]
    return nullptr;
  return caller.ports[port];
}

const NodeTexts& texts_of(const lockstep_caller& caller);

// For control nodes of plugins.
const lockstep_children& children_table();
// For all nodes of plugins.
const lockstep_place& place_table();
const lockstep_lasting& lasting_table();
const lockstep_changes& changes_table();
const lockstep_ticks& ticks_table();
const lockstep_reason& reason_table();
// Gives the engine the reason of a leaf's result.
void take_reason(const lockstep_caller& caller, const Shortened& text);

}  // namespace lockstep::host
