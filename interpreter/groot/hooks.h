// The breakpoints of Groot2 as those of a run. A run pauses between two ticks: after one in which
// the node began, or completed. What would put another status in place of a node's is refused.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/core/problem.h"
#include "run/run_control.h"
#include "trace/node_state.h"

namespace lockstep::host {

class GrootHooks {
 public:
  static constexpr std::size_t kMost = 100;

  // Of so many nodes, without groups. Null: nobody may pause the run.
  GrootHooks(std::size_t nodes, RunControl* control) : nodes_(nodes), control_(control) {}

  // Each takes JSON, and returns what is wrong with it, or "".
  std::string insert(const std::string& one_or_list);
  std::string remove(const std::string& which);
  std::string unlock(const std::string& which);

  void remove_all();
  void disable_all();
  // A JSON array.
  std::string dump() const;

  // While nobody is there who could let the run go on, it does not pause.
  void set_absent(bool is_absent);
  // The node at which the run has paused since the last call.
  std::optional<NodeIndex> reached();
  // The run is paused by one of these.
  std::optional<NodeIndex> paused_at() const;

 private:
  struct Key {
    std::uint64_t uid = 0;
    std::int64_t position = 0;  // 0: before the node's tick; 1: after it
    auto operator<=>(const Key&) const = default;
  };
  struct Hook {
    Key key;
    bool is_enabled = true;
    bool is_once = false;
    std::int64_t mode = 0;  // 0: a breakpoint; 1: a status in place of the node's
    std::string status = "SKIPPED";
  };
  using Hooks = std::map<Key, Hook>;

  std::string check(const Hook& hook) const;
  Result<Hooks::iterator> find(const Key& key);
  void put(const Hook& hook);
  Hooks::iterator erase(Hooks::iterator hook);
  void set(const Hook& hook, bool is_on);
  bool is_paused_by(const Hook& hook) const;
  void go_on_from(const Hook& hook);

  const std::size_t nodes_;
  RunControl* const control_;
  Hooks hooks_;
  bool is_absent_ = false;
  std::uint64_t pauses_ = 0;  // that were looked at
};

}  // namespace lockstep::host
