// What random trees of barriers and pools must reach.
#include <array>
#include <catch2/catch.hpp>
#include <numeric>

#include "property/coverage.h"
#include "property/reference_barrier.h"

namespace lockstep::host::test {
namespace {

constexpr long kOftenInGroups = 200;
constexpr long kSeldomInGroups = 20;
constexpr double kMostRefused = 0.05;

constexpr std::array kOftenSeen{
    "a member is held",
    "a member is held at a barrier that ignores who is idle",
    "a member passes after its success",
    "a member waits to begin",
    "all members begin",
    "a member of a group that is remapped",
    "a failed member counts 0",
    "a failed member comes back",
    "a failed member cannot come back",
    "a halted member cannot come back",
    "a member cannot come back: the common ancestor has latched it",
    "a member cannot come back: below a parallel with memory",
    "a member cannot come back: below a Sequence with memory",
    "a member cannot come back: below a SubTree",
    "in doubt, a member comes back: a while",
    "in doubt, a member comes back: below a parallel without memory",
    "a skipped member is left out",
    "a member is left out below a node that was skipped",
    "a guard is a member: it counts 1",
    "a guard is a member: it counts 0",
    "a member is idle: the others wait",
    "a member is idle: it is ignored",
    "a member is denied",
    "a member asks when it is first reached",
    "a member is skipped and gives back what it owned",
    "a member keeps its resources",
    "a priority saturates",
    "an increment of 0",
    "a Sequence is held between two children",
    "nested pools",
    "nested members of one pool",
    "resources come from an entry",
    "a gate is closed: a barrier around it",
    "a gate is closed: the SyncProgress directly inside of it",
};

constexpr std::array kSeldomSeen{
    "a member asks early for one inside of it",
    "a member takes over from the one before it",
    "a member is held by an entry: barriers",
    "a member is held by an entry: barrier_count",
    "a member is held by an entry: at_barrier",
    "a member is held by an entry: delta",
    "a limit in an entry is wrong while no member runs",
    "a limit in an entry is wrong while a member runs",
    "a member cannot come back: below a Fallback with memory",
    "a member cannot come back: below a Sequence without memory",
    "a member cannot come back: below a Fallback without memory",
    "a member cannot come back: below a IfThenElse",
    "a member cannot come back: below a Inverter",
    "a member cannot come back: below a ForceSuccess",
    "a member cannot come back: below a ForceFailure",
    "a member cannot come back: below a Timeout",
    "a member cannot come back: below a Delay",
    "a member cannot come back: below a RunOnce",
    "a member cannot come back: below a SyncProgress",
    "a member cannot come back: below a UseResources",
    "in doubt, a member comes back: below a Sequence without memory",
    "in doubt, a member comes back: below a Fallback without memory",
    "in doubt, a member comes back: below a Repeat",
    "in doubt, a member comes back: below a Retry",
    "in doubt, a member comes back: below a KeepRunningUntilFailure",
    "in doubt, a member comes back: below a Cooldown",
    "in doubt, a member comes back: below a Rate",
    "in doubt, a member comes back: below a WhileDoElse",
    "in doubt, a member comes back: below a Switch",
    "a member is held below a Parallel",
    "a member is held below a ParallelAbsolute",
    "a member is held below a ParallelRelative",
    "a member is held below a Sequence",
    "a member is held below a Fallback",
    "a member is held below a IfThenElse",
    "a member is held below a WhileDoElse",
    "a member is held below a Switch",
    "a member is held below a Inverter",
    "a member is held below a ForceSuccess",
    "a member is held below a ForceFailure",
    "a member is held below a Repeat",
    "a member is held below a Retry",
    "a member is held below a Timeout",
    "a member is held below a Delay",
    "a member is held below a Cooldown",
    "a member is held below a Rate",
    "a member is held below a RunOnce",
    "a member is held below a KeepRunningUntilFailure",
    "a member is held below a SubTree",
    "a member is held below a SyncProgress",
    "a member is held below a UseResources",
    "a member asks after a parallel has held it",
    "a failed member waits to begin again",
    "a grant is not used",
    "a member keeps its resources while a parallel holds it",
    "a member keeps its resources behind a closed gate",
    "a member keeps its resources when its entry has others",
    "a member exchanges its resources",
    "a member chooses again what it had",
    "a member chooses the first that is free",
    "none of several is free",
    "an entry says what a member got",
    "an entry names no resource of the pool",
    "a gate is closed: an outer UseResources",
    "a member is skipped after it has run",
};

}  // namespace

void GroupCoverage::count_tree(const std::string& refused) {
  ++trees_;
  if (!refused.empty()) ++refusals_[refused];
}

void GroupCoverage::count(const std::map<std::string, long>& cases) {
  for (const auto& [what, times] : cases) seen_[what] += times;
}

void GroupCoverage::check() const {
  const auto at_least = [this](long times, const std::string& what) {
    const auto seen = seen_.find(what);
    INFO("how often: " << what);
    CHECK((seen == seen_.end() ? 0 : seen->second) >= times);
  };
  for (const char* what : kOftenSeen) at_least(kOftenInGroups, what);
  for (const char* what : kSeldomSeen) at_least(kSeldomInGroups, what);
  double refused = 0;
  for (const auto& [message, trees] : refusals_) {
    UNSCOPED_INFO(trees << " refused: " << message);
    refused += static_cast<double>(trees);
  }
  CHECK(refused <= kMostRefused * static_cast<double>(trees_));
}

}  // namespace lockstep::host::test
