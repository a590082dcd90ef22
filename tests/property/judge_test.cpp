// What verify says of small random trees of both languages, against a judge that shares nothing
// with it: which results there are and how soon, whether the tree can always end and always ends,
// which nodes are ticked, succeed and fail, and which properties hold.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>
#include <utility>

#include "judge/measure/property_steps.h"
#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "property/judge.h"
#include "property/judged_trial.h"
#include "property/plan_repair.h"
#include "property/random_source.h"
#include "property/reference.h"
#include "run/shape_of.h"
#include "support/tree_text.h"
#include "support/trials.h"
#include "verify/verdict.h"

namespace lockstep::host::test {
namespace {

// ./dev judge sets others.
const std::uint64_t kJudgedTrees = trials(500);  // of each language
constexpr std::size_t kProperties = 3;
constexpr Nanoseconds kPeriod = from_seconds(kJudgedPeriod);
constexpr double kRate = 1 / kJudgedPeriod;
constexpr Nanoseconds kLongest = from_seconds(kJudgedLongest);

// A reference interpreter, and its leaves.
template <class Interpreter>
class Judged : public JudgedTree {
 public:
  template <class Source>
  Judged(const Source& tree, JudgedLeaves& leaves) : reference_(tree, &leaves), leaves_(leaves) {}

  std::string save() override {
    std::string of_leaves;
    KeptState leaves(of_leaves, {});
    leaves_.keep(leaves);
    return static_cast<char>(of_leaves.size()) + of_leaves + reference_.save(kLongest);
  }
  void restore(const std::string& state) override {
    const auto size = static_cast<std::size_t>(state[0]);
    const std::string of_leaves = state.substr(1, size);
    KeptState leaves(of_leaves, {});
    leaves_.keep(leaves);
    reference_.restore(state.substr(1 + size), kLongest);
  }
  Status status(std::size_t node) const override { return reference_.status(node); }
  bool ticked(std::size_t node) const override { return reference_.ticked(node); }

 protected:
  Interpreter reference_;

 private:
  JudgedLeaves& leaves_;
};

class JudgedPlan final : public Judged<Reference> {
 public:
  JudgedPlan(const Plan& plan, JudgedLeaves& leaves)
      : Judged(plan, leaves), nodes_(count_nodes(plan)) {
    leaves.set_write(
        [this](const std::string& entry, double value) { reference_.write(entry, value); });
  }
  bool cut() override { return reference_.cut(); }
  std::optional<Status> tick() override {
    const Status status = reference_.tick(Reference::kRestored + kPeriod);
    return reference_.fault() ? std::nullopt : std::optional(status);
  }
  std::size_t nodes() const override { return nodes_; }  // without barriers and pools
  std::span<const ReferenceMoment> moments() const override { return reference_.moments(); }

 private:
  const std::size_t nodes_;
};

class JudgedDocument final : public Judged<law::Reference> {
 public:
  JudgedDocument(const law::Document& document, JudgedLeaves& leaves) : Judged(document, leaves) {
    leaves.set_write(
        [this](const std::string& entry, double value) { reference_.write(entry, value); });
  }
  std::optional<Status> tick() override { return reference_.tick(); }
  std::size_t nodes() const override { return reference_.nodes(); }
};

// About nodes of the tree. At the end of a period, no node of BehaviorTree.CPP has a result that
// its parent has used.
std::vector<JudgedProperty> properties_of(std::uint64_t seed, std::size_t nodes, bool is_btcpp) {
  RandomSource random(seed + 1'000'000);
  if (random.one_in(2)) return {};  // nodes that are named keep their places
  const auto fact = [&] {
    return JudgedProperty::Fact{
        static_cast<std::size_t>(random.between(0, static_cast<int>(nodes) - 1)),
        static_cast<JudgedProperty::What>(random.between(0, is_btcpp ? 0 : 3))};
  };
  std::vector<JudgedProperty> all;
  while (all.size() < kProperties) all.push_back({fact(), fact(), random.one_in(2)});
  return all;
}

std::string text_of(const JudgedProperty& property, const Tree& tree) {
  constexpr std::array kWords{"running", "success", "failure", "ticked"};
  const auto fact = [&](const JudgedProperty::Fact& it) {
    return fmt::format("'{}'.{}", tree.path(static_cast<NodeIndex>(it.node)),
                       kWords[static_cast<std::size_t>(it.what)]);
  };
  const std::string one = fact(property.one), other = fact(property.other);
  return property.is_after ? fmt::format("after {} never {}", one, other)
                           : fmt::format("never {} and {}", one, other);
}

std::string of(const Judgment::First& first) {
  return first ? fmt::format("after {} ticks", *first) : "never";
}

// What verify says, claim by claim, beside what the judge says.
class Claims {
 public:
  Claims(const Tree& tree, const Judgment& judgment) : tree_(tree), judgment_(judgment) {}

  // The first claim that is wrong, or "".
  std::string compare(const SearchResult& found, const Verdict& verdict,
                      const std::vector<Property>& properties, bool is_btcpp) {
    compare_results(found);
    const Finding* trap = finding(verdict, "trap");
    same("the tree can no longer end", depth_of(trap), judgment_.lost, judgment_.run_to_lost);
    compare_cuts(finding(verdict, "trap-after-cut"));
    same("the tree may go on for ever", finding(verdict, "cycle") != nullptr, judgment_.is_endless,
         judgment_.run_to_cycle);
    compare_ticked(verdict);
    if (!is_btcpp) compare_nodes(found);
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const auto it = found.violated.find(i);
      const auto claimed =
          it == found.violated.end() ? std::nullopt : Judgment::First(it->second.ticks);
      // The reference for BehaviorTree.CPP has the state after a tick only, and verify its moments,
      // too: it may see more, and sooner, but nothing less.
      const Judgment::First& is = judgment_.violated[i];
      if (is_btcpp && claimed && (!is || *claimed <= *is)) continue;
      same(properties[i].name() + " is violated", claimed, is, judgment_.runs_to_violated[i]);
    }
    if (found.broken) wrong_ = "a call of a leaf: " + found.broken->first;
    return wrong_;
  }

 private:
  static const Finding* finding(const Verdict& verdict, std::string_view name) {
    const auto it = std::ranges::find(verdict.findings, name, &Finding::name);
    return it == verdict.findings.end() ? nullptr : &*it;
  }
  static Judgment::First depth_of(const Finding* trap) {
    if (trap == nullptr) return std::nullopt;
    if (!trap->message.starts_with("after ")) return 0;
    return static_cast<std::uint32_t>(std::stoul(trap->message.substr(6)));
  }

  void same(const std::string& what, bool claimed, bool is, const std::string& run) {
    if (claimed != is) tell(what, claimed ? "yes" : "no", is ? "yes" : "no", is ? run : "");
  }
  void same(const std::string& what, const Judgment::First& claimed, const Judgment::First& is,
            const std::string& run) {
    if (claimed != is) tell(what, of(claimed), of(is), run);
  }
  void tell(const std::string& what, const std::string& claimed, const std::string& is,
            const std::string& run) {
    if (!wrong_.empty()) return;
    wrong_ = fmt::format("{}: verify says {}, the judge {}", what, claimed, is);
    if (!run.empty()) wrong_ += "; in this run:\n" + run;
  }

  // Where it cannot end without a cut either, the judge does not tell the states apart as verify
  // does.
  void compare_cuts(const Finding* trap) {
    if (judgment_.lost) return;
    same("the tree can no longer end after a cut", depth_of(trap), judgment_.lost_by_cuts,
         judgment_.run_to_lost);
  }

  void compare_results(const SearchResult& found) {
    for (const StatusRow& row : kStatuses) {
      const std::size_t i = index_of(row.status);
      const auto& first = found.results[i];
      same(fmt::format("the root is {}", to_string(row.status)),
           first ? Judgment::First(first->ticks) : std::nullopt, judgment_.results[i],
           judgment_.runs_to_results[i]);
    }
  }

  void compare_ticked(const Verdict& verdict) {
    std::set<std::string> never, expected;
    for (const Finding& it : verdict.findings) {
      if (it.name.starts_with("never-ticked/")) never.insert(it.name);
    }
    for (NodeIndex node = 0; node < judgment_.ticked.size();) {
      const std::string name = "never-ticked/" + tree_.path(node);
      same(name, never.contains(name), !judgment_.ticked[node], judgment_.runs_to_ticked[node]);
      node = judgment_.ticked[node] ? node + 1 : tree_.nodes[node].end;
    }
  }

  void compare_nodes(const SearchResult& found) {
    for (NodeIndex node = 0; node < judgment_.ticked.size(); ++node) {
      same(tree_.path(node) + " succeeds", found.coverage.has_been(node, Status::Success),
           judgment_.succeeded[node], "");
      same(tree_.path(node) + " fails", found.coverage.has_been(node, Status::Failure),
           judgment_.failed[node], "");
    }
  }

  const Tree& tree_;
  const Judgment& judgment_;
  std::string wrong_;
};

struct Outcome {
  bool is_conclusive = false;
  std::string wrong = {};
  std::size_t states = 0;
};

Outcome try_trial(const JudgedTrial& trial, std::uint64_t seed, int cuts) {
  if (!trial.is_btcpp() && has_lonely_members(trial.plan)) return {};
  const Tree tree = trial.is_btcpp() ? law::tree_of(trial.document) : tree_from_text(trial.text());
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const auto file = read_leaf_file(
      "t.leaves.xml", "<leaves lockstep=\"1\">" + trial.rows() + "</leaves>", diagnostics);
  LeafModels models = make_models(tree, file.get(), diagnostics, problems);
  INFO((diagnostics.has_errors() ? diagnostics.all()[0].message : ""));
  REQUIRE_FALSE(diagnostics.has_errors());
  if (!problems.empty()) return {};
  allow_cuts({.most = static_cast<std::uint32_t>(cuts)}, tree, models);

  JudgedLeaves leaves(trial.rules(), trial.facts);
  const std::unique_ptr<JudgedTree> judged =
      trial.is_btcpp() ? std::unique_ptr<JudgedTree>(new JudgedDocument(trial.document, leaves))
                       : std::unique_ptr<JudgedTree>(new JudgedPlan(trial.plan, leaves));
  const auto both = properties_of(seed, judged->nodes(), trial.is_btcpp());
  const Judgment judgment = judge(*judged, leaves, both, {.cuts = cuts});
  if (!judgment.is_conclusive()) return {};

  std::vector<Property> properties;
  for (const JudgedProperty& it : both) {
    auto property = Property::parse(text_of(it, tree), property_names(shape_of(tree)));
    REQUIRE(property);
    properties.push_back(std::move(*property));
  }
  // Each second tree with its rounds told apart from the first tick on.
  const SearchResult found = search(tree, models, properties, kRate,
                                    {.transitions = 200'000,
                                     .few_root_ticks = seed % 2 == 0 ? 0 : kFewRootTicks,
                                     .few_ticks = seed % 3 == 0 ? kFewTicks : 0});
  Outcome outcome{.is_conclusive = true, .states = judgment.states};
  if (!judgment.broken.empty())
    outcome.wrong = "the reference breaks the contract: " + judgment.broken;
  if (!found.is_complete() || !found.faults.empty()) {
    outcome.wrong =
        fmt::format("verify has {} states, the judge {}", found.store.size(), judgment.states);
    return outcome;
  }
  for (const auto& [node, passed] : found.passed) {
    if (outcome.wrong.empty()) outcome.wrong = "a barrier is passed: " + passed.first;
  }
  const Verdict verdict = make_verdict(tree, models, properties, found, {.rate = 10});
  if (outcome.wrong.empty())
    outcome.wrong = Claims(tree, judgment).compare(found, verdict, properties, trial.is_btcpp());
  return outcome;
}

// The smallest one that is still wrong.
std::string report(JudgedTrial trial, std::uint64_t seed, int cuts) {
  for (bool is_smaller = true; is_smaller;) {
    is_smaller = false;
    for (JudgedTrial& it : smaller(trial)) {
      if (try_trial(it, seed, cuts).wrong.empty()) continue;
      trial = std::move(it);
      is_smaller = true;
      break;
    }
  }
  return fmt::format("seed {0}; again: ./dev judge 2 {0}\n  tree: {1}\n  leaves: {2}\n  {3}", seed,
                     trial.text(), trial.rows(), try_trial(trial, seed, cuts).wrong);
}

// `cuts`: of the process, in a run.
void judge_all(JudgedTrial (*make)(std::uint64_t), int cuts = 0,
               std::uint64_t usual = kJudgedTrees) {
  const char* const count = std::getenv("LOCKSTEP_JUDGED_TREES");
  const char* const first = std::getenv("LOCKSTEP_JUDGED_SEED");
  const std::uint64_t trees = count == nullptr ? usual : std::stoull(count) / 2;
  const std::uint64_t begin = first == nullptr ? 0 : std::stoull(first);
  std::uint64_t conclusive = 0, states = 0;
  for (std::uint64_t seed = begin; seed < begin + trees; ++seed) {
    const JudgedTrial trial = make(seed);
    const Outcome outcome = try_trial(trial, seed, cuts);
    conclusive += outcome.is_conclusive ? 1 : 0;
    states += outcome.states;
    if (!outcome.wrong.empty()) FAIL_CHECK(report(trial, seed, cuts));
  }
  INFO(conclusive << " of " << trees << " trees, " << states << " states");
  // Or most are too large for the judge, or have faults.
  CHECK(conclusive >= trees * (cuts == 0 ? 9 : 8) / 10);
  if (count != nullptr) {
    WARN(conclusive << " of " << trees << " trees, " << states << " states");
  }
}

}  // namespace

TEST_CASE("verify says of small trees what a judge finds by trying everything", "[trials]") {
  judge_all(judged_trial);
}

namespace {

// Each leaf with some of what it may do after a cut.
JudgedTrial judged_trial_with_cuts(std::uint64_t seed) {
  JudgedTrial trial = judged_trial(seed);
  RandomSource random(seed + 2'000'000);
  for (LeafRule& leaf : trial.leaves) {
    if (!leaf.is_action || random.one_in(3)) continue;
    for (const AfterCut it :
         {AfterCut::StartsAgain, AfterCut::Continues, AfterCut::Failure, AfterCut::Success}) {
      if (random.one_in(it == AfterCut::Success ? 6 : 2)) leaf.after_cut.push_back(it);
    }
  }
  return trial;
}

}  // namespace

TEST_CASE("verify --cuts says of small trees what a judge finds by trying everything", "[trials]") {
  judge_all(judged_trial_with_cuts, 1, kJudgedTrees / 2);
}

TEST_CASE("verify says of small trees for BehaviorTree.CPP what a judge finds", "[trials]") {
  judge_all(judged_btcpp_trial);
}

}  // namespace lockstep::host::test
