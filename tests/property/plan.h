// A tree as plain data: what the generator makes, the engine's tree text is written from, and the
// reference interpreter is built from.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lockstep::test {

struct Plan {
  std::string kind;  // of the language, or "action", "condition", "bare" for scripted leaves
  std::vector<Plan> children = {};

  // Scripted leaves.
  std::string name = {};
  std::string script = {};

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
  int times = -1;  // of Repeat, attempts of Retry
  double seconds = 0;
  bool wall_clock = false;   // Timeout, Delay, Rate
  std::string barrier = {};  // SyncProgress: the name of one of the root's

  std::string code = {};  // Script, Check; of Switch, what it is on
  std::vector<std::string> cases = {};

  std::string pool = {};  // UseResources: likewise
  std::string resources = {};
  bool keep = false;

  // Of any node: its scripts around ticks, by attribute.
  std::map<std::string, std::string> hooks = {};

  // Of the root: the barriers and pools beside the tree, by name. A barrier has a delta if it has
  // no list.
  std::vector<Plan> beside = {};
  bool ignores_idle = false;
  int increment = 1;
};

// As tree_from_text and ScriptedRun read them.
std::string tree_text(const Plan& plan);
std::string leaves_text(const Plan& plan);

// Of the root: the barriers and pools beside the tree that have members, in order.
std::vector<const Plan*> groups_of(const Plan& plan);

// No action is in it.
bool is_guard(const Plan& plan);

std::size_t count_nodes(const Plan& plan);

}  // namespace lockstep::test
