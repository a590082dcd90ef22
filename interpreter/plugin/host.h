// The host's side of the functions in lockstep_host: the caller, and what the call may access. Only
// within plugin/. Getters and setters neither lock nor look up a name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "core/shortened.h"
#include "core/value.h"
#include "engine/blackboard.h"
#include "engine/leaf_slot.h"
#include "lockstep/leaf.h"
#include "plugin/leaf_set.h"

namespace lockstep {

constexpr std::size_t kLongestLogLine = std::size_t{32} << 10;  // bytes; the rest is cut off

struct BoundPort {
  ValueType type;
  const Value* read = nullptr;      // null: no value
  Entry* write = nullptr;           // null: an input, or not bound to an entry
  const Value* fallback = nullptr;  // the default, while the entry that it is bound to has no value
  std::string_view name = {};       // unknown in a process that only mirrors the entries
  std::string_view entry = {};
};

}  // namespace lockstep

// A leaf of a run, or (without ports) a run itself.
struct lockstep_caller {
  std::string who;  // its path, or the plugin's name
  std::vector<lockstep::BoundPort> ports;
  lockstep::RandomStream random;
  const lockstep::LeafTime* time;
  const lockstep::LeafLog* log;
  lockstep::LeafSlot* slot;                 // its `error` tells of set_error
  const lockstep_plugin* plugin = nullptr;  // of a run: whose run context it is
  // Collects the entries that are set, for a process that only mirrors them; null: not collected.
  std::vector<lockstep::Entry*>* written = nullptr;
  lockstep::Shortened error = {};
};

namespace lockstep {

// What set_error does after shortening the message; the first error of a call is kept.
void take_error(const lockstep_caller& caller, const Shortened& message);

}  // namespace lockstep
