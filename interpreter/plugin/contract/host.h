// The host's side of the functions in lockstep_host: the caller, and what the call may access. Only
// within plugin/. Getters and setters neither lock nor look up a name.
#pragma once

#include <list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/node_type.h"
#include "core/random.h"
#include "core/shortened.h"
#include "core/value.h"
#include "engine/blackboard.h"
#include "engine/leaf_slot.h"
#include "lockstep/leaf.h"
#include "plugin/contract/call_mark.h"
#include "plugin/contract/leaf_set.h"

namespace lockstep::host {

constexpr std::size_t kLongestLogLine = std::size_t{32} << 10;  // bytes; the rest is cut off

struct BoundPort {
  ValueType type;
  const Value* read = nullptr;         // null: no value
  Entry* write = nullptr;              // null: an input, or not bound to an entry
  const Value* fallback = nullptr;     // the default, while the entry has no value
  const Parameter* limits = nullptr;   // null: it takes every value of its type
  const ObjectType* object = nullptr;  // of type Object: which
  bool is_strict = true;               // the entry holds values of its type only
  bool is_generic = false;             // takes values of any type; `type` is String
  Direction direction = Direction::Input;
  std::string_view name = {};
  std::string_view entry = {};
  std::vector<lockstep_text> texts = {};  // the list of strings that was handed out last
  Object packed = {}, unpacked = {};      // an object of another process, and what it was made into
  // What the entry has, as a value of the port's type: it may have another in trees that say so.
  std::unique_ptr<Value> converted = {};
  std::string given = {};  // what lockstep_place's `given` has handed out

  // The tree binds it to no entry: what the leaf sets is discarded.
  bool is_unbound() const { return direction != Direction::Input && write == nullptr; }
};

// A child of a control node, as the node sees it.
struct ChildLabel {
  std::string id, name;
};

}  // namespace lockstep::host

// A leaf of a run, or (without ports) a run itself.
struct lockstep_caller {
  std::string_view who;  // its path, or the plugin's name, which ends with a NUL
  std::vector<lockstep::host::BoundPort> ports;
  lockstep::host::RandomStream random;
  const lockstep::host::LeafTime* time;
  const lockstep::host::LeafLog* log;
  lockstep::host::LeafSlot* slot;            // set_error sets its `error`
  lockstep::host::Ticker* ticker = nullptr;  // null while leaves are made
  std::span<const lockstep::host::NodeIndex> children =
      {};                                   // of a control node or decorator, in order
  const lockstep_plugin* plugin = nullptr;  // of a run: whose run context it is
  const lockstep::host::CallSite* site = nullptr;
  // Collects the entries that are set, for a process that only mirrors them; null: not collected.
  std::vector<lockstep::host::Entry*>* written = nullptr;
  std::unique_ptr<lockstep::host::Shortened> error = {};  // the last; null: none yet
  lockstep::host::NodeIndex node = 0;                     // in the tree of its ticker
  std::string name = {};                                  // of the node
  std::string_view id = {};                               // of its type, which ends with a NUL
  std::string_view plugin_name = {};                      // of its type
  bool opens_entries = false;                             // lockstep_place::open
  std::list<std::string> opened = {};  // the keys of the ports behind those of its type
  std::vector<lockstep::host::ChildLabel> labels = {};

  // The calling thread is not the run's: it may only call log, so that it finds nothing to read or
  // to change while a tick goes on.
  bool is_foreign() const {
    return time->thread != nullptr && time->thread != lockstep::host::this_thread_id();
  }
};

namespace lockstep::host {

// The contract hands out constant callers, so that plugins keep their hands off.
inline lockstep_caller& mine(const lockstep_caller* caller) {
  return const_cast<lockstep_caller&>(*caller);  // NOLINT: every caller is made non-constant
}

// What set_error does after shortening the message; the first error of a call is kept.
void take_error(const lockstep_caller& caller, const Shortened& message);

// What the getters and setters of the table do, of a port of any type but Object. The value is null
// when there is none that the leaf may read.
const Value* read_port(const lockstep_caller& caller, std::uint32_t port);
bool write_port(const lockstep_caller& caller, std::uint32_t port, const Value& value);

// The port's declaration if it does not take every value of its type, else null.
const Parameter* limits_of(const Parameter& port);
// Where the node's ports read and write.
std::vector<BoundPort> bind_ports(const Tree& tree, const LeafNode& node, Blackboard& blackboard);
// Its children in the tree, in order.
std::span<const NodeIndex> children_of(const Tree& tree, const LeafNode& node);

// For control nodes of plugins.
const lockstep_children& children_table();
// For all nodes of plugins.
const lockstep_place& place_table();

}  // namespace lockstep::host
