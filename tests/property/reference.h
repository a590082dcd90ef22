// The law of the language once more, slow and obvious: an object for each node that calls its
// children. It shares nothing with engine/; the property tests hold the two against each other.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "base/core/clock.h"
#include "base/core/status.h"
#include "property/kept_state.h"
#include "property/leaf_behavior.h"
#include "property/plan.h"
#include "support/event_log.h"

namespace lockstep::host::test {

class ReferenceNode;
class ReferenceGroup;

// Of each node: what the tick has made of it up to here.
struct ReferenceState {
  Status status;
  bool ticked;
};
using ReferenceMoment = std::vector<ReferenceState>;

class Reference {
 public:
  struct World;
  // `behavior`: of the leaves, in place of their scripts; it outlives this.
  explicit Reference(const Plan& plan, LeafBehavior* behavior = nullptr);
  ~Reference();
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  // The root's status. After a fault, everything has been halted.
  Status tick(Nanoseconds now);
  void halt();
  // Its process ends without a halt, and another one goes on. False: no leaf ran.
  bool cut();
  // As a leaf would.
  void write(const std::string& entry, const std::variant<double, std::string>& value);

  // All that it keeps between two ticks. No duration in the tree is longer than `longest`.
  std::string save(Nanoseconds longest);
  // It goes on from there: the next tick is `kRestored` and what the clock has advanced since then.
  void restore(const std::string& state, Nanoseconds longest);
  static constexpr Nanoseconds kRestored = std::chrono::hours(1);

  // Nodes are numbered in pre-order.
  Status status(std::size_t node) const;
  bool ticked(std::size_t node) const;  // in the last tick
  bool held(std::size_t node) const;
  // A new moment of a tick begins when a node that has begun or completed in this one, or that this
  // tick withholds its ticks from, is halted or reset. Those of the last tick, but for the last
  // one, which is the state after the tick.
  const std::vector<ReferenceMoment>& moments() const;
  double progress(std::size_t node);  // may find a fault
  // What a synchronized node saw at the start of its last tick, not a number for a member of a
  // barrier that was left out; empty for other nodes.
  const std::vector<double>& snapshot(std::size_t node) const;
  // The leaf at fault.
  const std::optional<std::size_t>& fault() const;

  // Cases of the law by name, and how often they came up.
  const std::map<std::string, long>& cases() const;

  EventLog events;  // since it was last cleared

 private:
  friend class ReferenceNode;
  void order_groups();
  void find_meanings(ReferenceNode& node) const;
  // What scripts read of the run, before the tick. False after a fault.
  bool read_nodes();
  void keep(KeptState& state);
  // After a halt, of the nodes that ran: those of children before those of their parents.
  void run_halt_scripts(const ReferenceNode& node, const std::vector<bool>& ran);

  std::unique_ptr<World> world_;
  std::vector<ReferenceNode*> nodes_;
  std::unique_ptr<ReferenceNode> root_;
  std::set<std::string> read_;                           // "progress(a0)"
  std::vector<std::unique_ptr<ReferenceGroup>> groups_;  // beside the tree
};

}  // namespace lockstep::host::test
