// The fold of each node kind, made wrong in both ways: one that forgets all that the node keeps is
// seen in what a run does, one that forgets nothing is seen in the number of states. And each
// statement of a kind on what it reads of others, left out: that is seen in what a run does. So the
// tests of the folds can fail, for each of them.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <deque>
#include <set>

#include "engine/nodes/fold.h"
#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "property/folded_run.h"
#include "support/tree_text.h"

namespace lockstep::host::test {
namespace {

constexpr int kFoldMutantTicks = 40;

using Fold = void (*)(NodeContext& context, NodeIndex self);

// A tree whose nodes of a kind say something else. Nodes that read entries or have scripts
// have a kind that is a copy.
struct Mutant {
  template <class Change>
  Mutant(const Tree& right, std::string_view id, Change change) : tree(right) {
    for (Node& node : tree.nodes) {
      if (node.kind->type.id != id) continue;
      kinds.push_back(*node.kind);
      change(kinds.back());
      node.kind = &kinds.back();
    }
  }
  Mutant(const Tree& right, std::string_view id, Fold fold)
      : Mutant(right, id, [fold](NodeKind& kind) { kind.fold = fold; }) {}
  Mutant(const Mutant&) = delete;
  Mutant& operator=(const Mutant&) = delete;

  Tree tree;
  std::deque<NodeKind> kinds;
};

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
  for (int tick = 0; tick < kFoldMutantTicks && plain.ticker().fault() == nullptr; ++tick) {
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
    fold(folded);
  }
  return false;
}

// In another process: a node may not find its way without what it kept.
bool differs_or_ends(const Subject& subject, const Tree& other) {
  constexpr unsigned kLongest = 10;  // seconds
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGSEGV, SIG_DFL);
    alarm(kLongest);
    _exit(differs(subject, other) ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return !WIFEXITED(status) || WEXITSTATUS(status) != 0;
}

// How many states it goes through.
std::size_t count_states(const Subject& subject, const Tree& tree) {
  ScriptedRun run(tree, subject.leaves);
  std::vector<RunState> states;
  for (int tick = 0; tick < kFoldMutantTicks && run.ticker().fault() == nullptr; ++tick) {
    subject.write(run, tick);
    run.tick(tick == 0 ? Nanoseconds(0) : from_seconds(subject.period));
    fold(run);
    const RunState& state = run.ticker().run_state();
    if (std::ranges::find(states, state) == states.end()) states.push_back(state);
  }
  return states.size();
}

// What a kind says that it reads of others.
using Reads = bool NodeKind::*;
constexpr Reads kReads[] = {&NodeKind::reads_own_hold, &NodeKind::reads_hold_of_members,
                            &NodeKind::reads_ended_members, &NodeKind::passes_over_branches};

// The kinds whose wrong folds, or statements, no subject has shown yet.
class Mutants {
 public:
  explicit Mutants(const LanguageRules& rules,
                   const std::set<std::string_view>& of_another_test = {}) {
    for (const NodeKind* kind : rules.kinds) {
      if (of_another_test.contains(kind->type.id)) continue;
      if (kind->fold != nullptr && kind->fold != &fold::dead) forget_all_.insert(kind->type.id);
      if (is_folded(*kind)) forget_nothing_.insert(kind->type.id);
      for (const Reads reads : kReads) {
        if (kind->*reads) say_nothing_.emplace_back(kind->type.id, reads);
      }
    }
  }

  void try_on(const Subject& subject) {
    std::set<std::string_view> kinds;
    for (const Node& node : subject.tree.nodes) kinds.insert(node.kind->type.id);
    for (const std::string_view id : kinds) {
      if (forget_all_.contains(id) &&
          differs_or_ends(subject, Mutant(subject.tree, id, fold::dead).tree)) {
        forget_all_.erase(id);
      }
      if (forget_nothing_.contains(id) &&
          count_states(subject, Mutant(subject.tree, id, fold::live).tree) >
              count_states(subject, subject.tree)) {
        forget_nothing_.erase(id);
      }
    }
    std::erase_if(say_nothing_, [&](const auto& it) {
      const auto& [id, reads] = it;
      return kinds.contains(id) &&
             differs_or_ends(subject, Mutant(subject.tree, id, [&](NodeKind& kind) {
                                        kind.*reads = false;
                                      }).tree);
    });
  }

  bool are_dead() const {
    return forget_all_.empty() && forget_nothing_.empty() && say_nothing_.empty();
  }
  std::string alive() const {
    std::string text;
    for (const std::string_view id : forget_all_) text += " " + std::string(id) + "(all)";
    for (const std::string_view id : forget_nothing_) text += " " + std::string(id) + "(nothing)";
    for (const auto& it : say_nothing_) text += " " + std::string(it.first) + "(reads)";
    return text;
  }

 private:
  std::set<std::string_view> forget_all_, forget_nothing_;
  std::vector<std::pair<std::string_view, Reads>> say_nothing_;
};

}  // namespace

TEST_CASE("a fold that forgets too much or nothing, or what is read, is seen for each kind") {
  constexpr std::uint64_t kMost = 2000;
  // InStep waits for robots that run other trees: tests/property/team_test.cpp.
  Mutants mutants(kLockstepRules, {"InStep"});
  // A Rate that is held, and asked again after that before its time is over, is rare.
  mutants.try_on({tree_from_text("ParallelAbsolute[barriers=.5](a Repeat(Rate[seconds=.5](b)))"),
                  "a+.1 b=R.6R.6S..."});
  mutants.try_on({tree_from_text("ParallelAbsolute[barriers=.5](a Timeout[seconds=.4](b))"),
                  "a+.1 b=R.6R.6R.6S..."});
  mutants.try_on({tree_from_text("ParallelAbsolute[barriers=.5](a Sequence[memory=true](c "
                                 "WaitUntil[code=1>2 timeout=.4]))"),
                  "a+.1 c=S"});
  mutants.try_on({tree_from_text("ParallelAbsolute[barriers=.5](a Sequence[memory=true]"
                                 "(b Delay[seconds=.4](c)))"),
                  "a+.1 b=S c=RS..."});
  mutants.try_on({tree_from_text("ParallelAbsolute[barriers=.5](a Sequence[memory=true]"
                                 "(b Ask[text=Now? timeout=.3]))"),
                  "a=R.1R.1R.1R.1R.6 b=S"});
  for (std::uint64_t seed = 0; seed < kMost && !mutants.are_dead(); ++seed) {
    for (const Trial& trial : {random_trial(seed), random_group_trial(seed)}) {
      const auto tree = tree_of(trial).tree;
      if (!tree) continue;
      mutants.try_on({*tree, leaves_text(trial.plan), &trial, trial.period});
    }
  }
  // No trial has more states because of what a Parallel keeps.
  CHECK(mutants.alive() == " Parallel(nothing)");
}

TEST_CASE("a fold that forgets too much or nothing is seen for each kind of BehaviorTree.CPP") {
  constexpr std::uint64_t kMost = 6000;
  const LanguageRules* const rules = languages()[1];
  // These rows are those of lockstep's own language.
  Mutants mutants(*rules,
                  {"SyncProgress", "UseResources", "WaitUntil", "InStep", "barrier", "resources"});
  // A branch in which somebody is held when the condition takes time again is rare.
  mutants.try_on({tree_from_text("WhileDoElse(Fallback(Sleep[msec=200]) "
                                 "ParallelAbsolute[barriers=.5](Inverter(a) b))",
                                 *rules),
                  "a=R.6 b=R.1"});
  for (std::uint64_t seed = 1; seed <= kMost && !mutants.are_dead(); ++seed) {
    const law::Document document = law::random_document(seed);
    const Tree tree = law::tree_of(document);
    mutants.try_on({tree, law::leaves_text(document)});
  }
  // Switch3 to Switch6 and the other loops, which no random document has, are rows over what
  // Switch2 and LoopInt have. No random document has more
  // states because of what Repeat and RetryUntilSuccessful keep.
  CHECK(mutants.alive() ==
        " LoopBool(all) LoopDouble(all) LoopString(all) Switch3(all) Switch4(all) Switch5(all)"
        " Switch6(all) LoopBool(nothing) LoopDouble(nothing) LoopString(nothing) Repeat(nothing)"
        " RetryUntilSuccessful(nothing) Switch3(nothing) Switch4(nothing) Switch5(nothing)"
        " Switch6(nothing)");
}

}  // namespace lockstep::host::test
