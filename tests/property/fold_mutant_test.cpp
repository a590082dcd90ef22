// The fold of each node kind, made wrong in both ways: one that forgets all that the node keeps is
// seen in what a run does, one that forgets nothing is seen in the number of states. So the tests
// of the folds can fail, for each of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "engine/nodes/fold.h"
#include "property/btcpp_tree.h"
#include "property/comparison.h"

namespace lockstep::host::test {
namespace {

constexpr int kTicks = 40;

// A tree whose nodes of a kind are of another.
Tree with_kind(Tree tree, const NodeKind& kind, const NodeKind& other) {
  for (Node& node : tree.nodes) {
    if (node.kind == &kind) node.kind = &other;
  }
  return tree;
}

bool is_folded(const NodeKind& kind) {
  return kind.fold != nullptr && kind.fold != &fold::live;
}

// What is done with two runs before each of their ticks.
struct Subject {
  const Tree& tree;
  std::string leaves;
  const Trial* trial = nullptr;
  double period = 0.1;

  void write(ScriptedRun& run, int tick) const {
    if (trial != nullptr) write_entries(run, *trial, tick);
  }
};

// Whether a run that is folded after each tick does otherwise than one that is not.
bool differs(const Subject& subject, const Tree& other) {
  ScriptedRun plain(subject.tree, subject.leaves), folded(other, subject.leaves);
  const Nanoseconds step = from_seconds(subject.period);
  for (int tick = 0; tick < kTicks && plain.ticker().fault() == nullptr; ++tick) {
    subject.write(plain, tick);
    subject.write(folded, tick);
    plain.events.clear();
    folded.events.clear();
    const Status right = plain.tick(tick * step);
    const Status status = folded.tick(tick == 0 ? Nanoseconds(0) : step);
    if (status != right || folded.events != plain.events) return true;
    for (NodeIndex node = 0; node < subject.tree.nodes.size(); ++node) {
      if (folded.ticker().activity(node) != plain.ticker().activity(node)) return true;
      if (folded.ticker().progress(node) != plain.ticker().progress(node)) return true;
      if (has_ended(plain.ticker().status(node))) node = plain.ticker().end_of(node) - 1;
    }
    folded.ticker().fold();
  }
  return false;
}

// How many states it goes through.
std::size_t count_states(const Subject& subject, const Tree& tree) {
  ScriptedRun run(tree, subject.leaves);
  std::vector<RunState> states;
  for (int tick = 0; tick < kTicks && run.ticker().fault() == nullptr; ++tick) {
    subject.write(run, tick);
    run.tick(tick == 0 ? Nanoseconds(0) : from_seconds(subject.period));
    run.ticker().fold();
    const RunState& state = run.ticker().run_state();
    if (std::ranges::find(states, state) == states.end()) states.push_back(state);
  }
  return states.size();
}

// The kinds whose wrong folds no subject has shown yet.
class Mutants {
 public:
  explicit Mutants(const LanguageRules& rules) {
    for (const NodeKind* kind : rules.kinds) {
      if (kind->fold != nullptr && kind->fold != &fold::dead) forget_all_[kind] = *kind;
      if (is_folded(*kind)) forget_nothing_[kind] = *kind;
    }
    for (auto& [kind, mutant] : forget_all_) mutant.fold = fold::dead;
    for (auto& [kind, mutant] : forget_nothing_) mutant.fold = fold::live;
  }

  void try_on(const Subject& subject) {
    std::set<const NodeKind*> kinds;
    for (const Node& node : subject.tree.nodes) kinds.insert(node.kind);
    for (const NodeKind* kind : kinds) {
      const auto all = forget_all_.find(kind);
      if (all != forget_all_.end() &&
          differs(subject, with_kind(subject.tree, *kind, all->second))) {
        forget_all_.erase(all);
      }
      const auto nothing = forget_nothing_.find(kind);
      if (nothing != forget_nothing_.end() &&
          count_states(subject, with_kind(subject.tree, *kind, nothing->second)) >
              count_states(subject, subject.tree)) {
        forget_nothing_.erase(nothing);
      }
    }
  }

  bool are_dead() const { return forget_all_.empty() && forget_nothing_.empty(); }
  std::string alive() const {
    std::string text;
    for (const auto& [kind, mutant] : forget_all_)
      text += " " + std::string(kind->type.id) + "(all)";
    for (const auto& [kind, mutant] : forget_nothing_) {
      text += " " + std::string(kind->type.id) + "(nothing)";
    }
    return text;
  }

 private:
  std::map<const NodeKind*, NodeKind> forget_all_, forget_nothing_;
};

}  // namespace

TEST_CASE("a fold that forgets too much, or nothing, is seen: each kind") {
  constexpr std::uint64_t kMost = 4000;
  Mutants mutants(kLockstepRules);
  for (std::uint64_t seed = 0; seed < kMost && !mutants.are_dead(); ++seed) {
    for (const Trial& trial : {random_trial(seed), random_group_trial(seed)}) {
      const auto tree = tree_of(trial).tree;
      if (!tree) continue;
      mutants.try_on({*tree, leaves_text(trial.plan), &trial, trial.period});
    }
  }
  CHECK(mutants.alive() == "");
}

TEST_CASE("a fold that forgets too much, or nothing, is seen: each kind of BehaviorTree.CPP") {
  constexpr std::uint64_t kMost = 20'000;
  const LanguageRules* const rules = languages()[1];
  Mutants mutants(*rules);
  for (std::uint64_t seed = 1; seed <= kMost && !mutants.are_dead(); ++seed) {
    const law::Document document = law::random_document(seed);
    const Tree tree = law::tree_of(document);
    mutants.try_on({tree, law::leaves_text(document)});
  }
  CHECK(mutants.alive() == "");
}

}  // namespace lockstep::host::test
