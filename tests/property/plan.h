// A tree as plain data: what the generator makes, the engine's tree text is written from, and the
// reference interpreter is built from.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lockstep::host::test {

struct Plan {
  std::string kind;  // of the language, or "action", "condition", "bare" for scripted leaves
  std::vector<Plan> children = {};

  // Scripted leaves.
  std::string name = {};
  std::string script = {};
  std::string output = {};  // the entry that it writes

  // Built-ins; each uses the ones that are its own. Absent: -1.
  bool memory = false;   // Sequence, Fallback
  bool forgets = false;  // the parallels: memory="false"
  int success_count = -1;
  int failure_count = -1;
  bool has_barriers = false;
  std::vector<double> barriers = {};
  int barrier_count = -1;
  bool tick_at_barrier = false;
  double delta = 0;
  bool holds_between = false;
  bool pace = false;  // of those that compare progress
  double reaction = 1;
  int times = -1;  // of Repeat, attempts of Retry
  double seconds = 0;
  bool wall_clock = false;   // Timeout, Delay, Rate
  std::string barrier = {};  // SyncProgress: the name of one of the root's

  std::string fallback = {};  // of an Ask, when its time is over
  std::string code = {};      // Script, Check; of Switch, what it is on
  std::vector<std::string> cases = {};

  // SubTree: what names of barriers and pools mean inside.
  std::map<std::string, std::string> renames = {};

  std::string pool = {};  // UseResources: likewise
  std::string resources = {};
  bool keep = false;
  std::string on_change = {};

  // Of any node: its scripts around ticks, by attribute.
  std::map<std::string, std::string> hooks = {};

  // Of the root: the barriers and pools beside the tree, by name. A barrier has a delta if it has
  // no list.
  std::vector<Plan> beside = {};
  bool ignores_idle = false;
  int increment = 1;

  // Of a barrier or a UseResources: the parameters that are entries, with their keys.
  std::map<std::string, std::string> from_entries = {};
};

// What the names of groups mean in a tree; those that are not there mean themselves.
using GroupNames = std::map<std::string, std::string>;
std::string meaning(const GroupNames& names, const std::string& name);
GroupNames names_inside(const Plan& plan, const GroupNames& names);

// Of a node, with their texts: all but its name.
using Attributes = std::vector<std::pair<std::string, std::string>>;
Attributes attributes_of(const Plan& plan);

// As tree_from_text and ScriptedRun read them.
std::string tree_text(const Plan& plan);
std::string leaves_text(const Plan& plan);

// Of the root: the barriers and pools beside the tree that have members, in order, whatever names
// these have for them.
std::vector<const Plan*> groups_of(const Plan& plan);

// What the scripts of a node read of the run: "progress(a0)", "owner(p/A)".
std::vector<std::string> readings_in(const Plan& plan);
// Puts something else in place of those that the tree does not have.
void take_out_unknown_readings(Plan& plan);

// No action is in it.
bool is_guard(const Plan& plan);

std::size_t count_nodes(const Plan& plan);

}  // namespace lockstep::host::test
