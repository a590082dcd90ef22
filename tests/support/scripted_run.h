// A run of a tree text with scripted leaves on the engine's ticker: what the tables and the
// property tests drive.
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "engine/saved_run.h"
#include "engine/ticker.h"
#include "support/plugin_nodes.h"
#include "support/scripted_leaf.h"

namespace lockstep::host::test {

class ScriptedRun {
 public:
  // `leaves`: "a=RRS b+.1 c=R~0,1", a script for each leaf of the tree. Throws
  // std::invalid_argument.
  ScriptedRun(std::string_view tree, std::string_view leaves,
              FaultPolicy policy = FaultPolicy::Stop, const LanguageRules& rules = kLockstepRules);
  // The watch may be null; else it outlives the run.
  ScriptedRun(Tree tree, std::string_view leaves, FaultPolicy policy = FaultPolicy::Stop,
              LeafWatch* watch = nullptr);
  ScriptedRun(const ScriptedRun&) = delete;
  ScriptedRun& operator=(const ScriptedRun&) = delete;

  Status tick_root(Nanoseconds now);
  // The same; after a fault, everything has been halted.
  Status tick(Nanoseconds now);
  // Ends the run as its owner would, and makes everything as new.
  void restart();

  // All of it between two ticks, its leaves too. Not of a tree with nodes of plugins.
  struct Saved {
    SavedRun engine;
    std::deque<ScriptedLeaf> leaves;
    std::uint32_t tree_tick = 0;
  };
  Saved save() const;
  void restore(const Saved& from);
  // The same of what another run of such a tree has saved.
  void go_on_as(const Saved& from);

  const Tree& tree() const { return tree_; }
  Ticker& ticker() { return ticker_; }
  // Writes an entry, as a leaf would.
  void set(std::string_view key, Value value);
  std::string text_of(std::string_view key);
  std::string leaf_name(std::uint32_t leaf) const;
  const ScriptedLeaf& leaf(std::size_t number) const { return leaves_[number]; }
  EventLog events;  // since it was last cleared

 private:
  Entry& entry(std::string_view key);

  Tree tree_;
  Blackboard board_;
  std::uint32_t tree_tick_ = 0;
  std::deque<ScriptedLeaf> leaves_;
  std::vector<LeafSlot> slots_;
  PluginNodes plugin_nodes_;
  Ticker ticker_;
};

}  // namespace lockstep::host::test
