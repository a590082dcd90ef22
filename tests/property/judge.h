// A judge of verify that shares nothing with it: it takes a reference interpreter through all runs
// of a small tree, each leaf with all that it may do, and knows two states as one only if all that
// the interpreter keeps is the same.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/status.h"
#include "property/judged_leaves.h"
#include "property/reference.h"

namespace lockstep::host::test {

// A tree in an interpreter that can be taken to any state.
class JudgedTree {
 public:
  virtual ~JudgedTree() = default;
  virtual std::string save() = 0;
  virtual void restore(const std::string& state) = 0;
  // Its process is cut. False: nothing ran that could notice.
  virtual bool cut() { return false; }
  // One period. Nothing after a fault.
  virtual std::optional<Status> tick() = 0;
  // Of the last tick. Nodes are numbered in pre-order.
  virtual std::size_t nodes() const = 0;
  virtual Status status(std::size_t node) const = 0;
  virtual bool ticked(std::size_t node) const = 0;
  // The moments before the last one, which is the state after the tick. Empty as well where the
  // interpreter has none.
  virtual std::span<const ReferenceMoment> moments() const { return {}; }
};

// "never ONE and OTHER", or "after ONE never OTHER".
struct JudgedProperty {
  enum class What : std::uint8_t { Running, Success, Failure, Ticked };
  struct Fact {
    std::size_t node;
    What what;
  };
  Fact one, other;
  bool is_after = false;
};

struct Judgment {
  // Nothing else counts: some run has a fault, or there are more states than the judge looks at.
  bool has_fault = false, is_too_large = false;
  std::string broken = {};  // a call of a leaf that the contract forbids

  using First = std::optional<std::uint32_t>;  // the ticks of a shortest run to it
  std::array<First, kStatuses.size()> results = {};
  First lost = {};          // no run without a cut goes on to an end
  First lost_by_cuts = {};  // the same of a run that was cut
  bool is_endless = false;  // a run goes on for ever, fairly, and could end in each tick
  std::vector<bool> ticked = {}, succeeded = {}, failed = {};  // of each node
  std::vector<First> violated = {};                            // of each property
  std::size_t states = 0;

  // Runs that show it, a line for each tick.
  std::array<std::string, kStatuses.size()> runs_to_results = {};
  std::string run_to_lost = {}, run_to_cycle = {};
  std::vector<std::string> runs_to_ticked = {}, runs_to_violated = {};

  bool is_conclusive() const { return !has_fault && !is_too_large; }
};

struct JudgeLimits {
  std::size_t states = 1500, ticks = 12'000;
  int cuts = 0;  // of the process, at most, in a run
};

Judgment judge(JudgedTree& tree, JudgedLeaves& leaves,
               const std::vector<JudgedProperty>& properties, const JudgeLimits& limits);

}  // namespace lockstep::host::test
