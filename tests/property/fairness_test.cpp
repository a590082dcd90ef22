// The laws of resources on random trees: one owner, no deadlock, nobody waits for long.
#include <catch2/catch.hpp>

#include "engine/resources.h"
#include "property/random_tree.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

constexpr int kFairnessTrees = 6000;
constexpr int kFewestWaits = 1000;  // members that waited

bool may_keep(const Plan& plan) {
  return plan.keep || !plan.on_change.empty() || std::ranges::any_of(plan.children, may_keep);
}

// Follows one pool of a run, tick by tick.
class PoolWatch {
 public:
  PoolWatch(ScriptedRun& run, NodeIndex pool, int increment, bool keeps)
      : run_(run),
        members_(run.tree().members_of(pool)),
        is_fair_(increment > 0 && !keeps && !run.tree().group(pool).has_relatives),
        keeps_(keeps),
        waits_(members_.size()) {}

  // Who begins anew waits anew.
  void before_tick() {
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (run_.ticker().status(members_[i].node) != Status::Running) waits_[i] = 0;
    }
  }

  void after_tick() {
    bool somebody_waits = false, somebody_asked_first = false;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const auto& use = run_.ticker().state<ResourceUse>(members_[i].node);
      const bool asked = resources::has_asked(run_.ticker(), use);
      const bool ticked = run_.ticker().ticked(members_[i].node);  // else a parallel held it
      const bool waits = asked && ticked && use.grant == Grant::Denied;
      waits_[i] = waits ? waits_[i] + 1 : 0;
      most_ = std::max(most_, waits_[i]);
      somebody_waits |= waits;
      waited_ += waits;
      if (!asked || use.grant != Grant::Owned) continue;
      somebody_asked_first = true;  // it has given back what it owned if its child was skipped
      for (std::size_t other = 0; other < i; ++other) CHECK(!share(other, i));
    }
    // Members that wait for other resources while they keep some may all wait.
    if (somebody_waits && !keeps_) CHECK(somebody_asked_first);
    if (is_fair_) CHECK(most_ < static_cast<int>(members_.size()));
  }
  int waited() const { return waited_; }
  bool is_longest() const { return most_ + 1 == static_cast<int>(members_.size()); }

 private:
  // One may own what it is inside of owns, and what one that has ended in this tick has owned.
  bool share(std::size_t one, std::size_t other) const {
    const NodeIndex outer = members_[one].node, node = members_[other].node;
    if (node < run_.ticker().end_of(outer)) return false;
    if (run_.ticker().status(outer) != Status::Running) return false;
    const auto owned = [&](NodeIndex it) {
      return owned_set(run_.ticker().state<ResourceUse>(it).limit);
    };
    return (owned(outer) & owned(node)) != 0;
  }

  ScriptedRun& run_;
  std::span<const Member> members_;
  bool is_fair_, keeps_;
  std::vector<int> waits_;  // of each member: ticks in a row
  int most_ = 0, waited_ = 0;
};

}  // namespace

TEST_CASE("resources have one owner, and with an increment nobody waits for N ticks") {
  int waited = 0, longest = 0;
  for (std::uint64_t seed = 0; seed < kFairnessTrees; ++seed) {
    const Trial trial = random_trial(seed);
    ScriptedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    std::vector<PoolWatch> pools;
    for (const Group& group : run.tree().groups) {
      const auto name = run.tree().labels[group.node].name;
      const auto plan = std::ranges::find(trial.plan.beside, name, &Plan::name);
      if (plan->kind != "resources") continue;
      pools.emplace_back(run, group.node, plan->increment, may_keep(trial.plan));
    }
    if (pools.empty()) continue;
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    for (int tick = 0; tick < trial.ticks && run.ticker().fault() == nullptr; ++tick) {
      for (PoolWatch& pool : pools) pool.before_tick();
      run.tick(tick * from_seconds(trial.period));
      for (PoolWatch& pool : pools) pool.after_tick();
    }
    for (const PoolWatch& pool : pools) {
      waited += pool.waited();
      longest += pool.is_longest() && pool.waited() > 0;
    }
  }
  CHECK(waited >= kFewestWaits);
  CHECK(longest > 0);  // so the bound is tight
}

}  // namespace lockstep::host::test
