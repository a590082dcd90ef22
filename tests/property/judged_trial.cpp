#include "property/judged_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "property/plan_repair.h"
#include "property/random_source.h"
#include "property/random_tree.h"

namespace lockstep::host::test {
namespace {

constexpr int kMostJudgedLeaves = 4;

class LeafRules : protected RandomSource {
 protected:
  explicit LeafRules(std::uint64_t seed) : RandomSource(seed) {
    parts_ = pick(std::array{0, 0, 2, 2, 4});
    may_skip_ = one_in(4);
    if (!one_in(4)) return;
    for (int i = between(1, 2); i > 0; --i) {
      facts_.push_back({static_cast<FactRule::Changes>(between(0, 3))});
    }
  }

  // Its name.
  std::string leaf(bool is_action) {
    LeafRule rule{.name = fmt::format("a{}", leaves_.size()), .is_action = is_action};
    if (is_action) draw_action(rule);
    if (may_skip_ && one_in(3)) rule.skips = true;
    const auto a_fact = [&] { return between(0, static_cast<int>(facts_.size()) - 1); };
    if (!facts_.empty() && !is_action && !one_in(4)) rule.fact = a_fact();
    if (!facts_.empty() && is_action && rule.succeeds && one_in(2)) {
      rule.sets = a_fact();
      rule.sets_to = one_in(2);
    }
    leaves_.push_back(rule);
    return rule.name;
  }
  // Of the last leaf: the entry that it writes, if any.
  std::string output(const std::vector<std::string>& entries) {
    LeafRule& rule = leaves_.back();
    if (!one_in(3)) return "";
    rule.entry = pick(entries);
    rule.writes =
        one_in(2) ? LeafRule::Writes::InAnyTick : static_cast<LeafRule::Writes>(between(0, 2));
    return rule.entry;
  }
  bool has_leaf_left() const { return leaves_.size() < kMostJudgedLeaves; }

  int parts_;  // of all that have progress
  bool may_skip_;
  std::vector<LeafRule> leaves_;
  std::vector<FactRule> facts_;

 private:
  void draw_action(LeafRule& rule) {
    const int results = between(0, 3);
    rule.fails = results < 2;
    rule.succeeds = results != 0 || one_in(2);
    if (one_in(2)) rule.most_ticks = between(1, 2);
    if (rule.most_ticks == 2 && one_in(3)) rule.least_ticks = 2;
    if (parts_ == 0 || one_in(5)) return;
    rule.parts = parts_;
    rule.most_step = between(1, parts_);
    if (one_in(4)) rule.least_step = pick(std::array{1, 1, -1});
    rule.finishes_full = rule.succeeds && rule.most_ticks == 0 && one_in(2);
    if (one_in(6)) rule.least_drift = -1;
    if (one_in(8)) rule.most_drift = 1;
  }
};

class SmallTree : LeafRules {
 public:
  explicit SmallTree(std::uint64_t seed) : LeafRules(seed) {}

  JudgedTrial trial() {
    budget_ = between(3, 12);
    scripts_ = one_in(4);
    JudgedTrial trial;
    Plan tree = one_in(3) ? node(1) : one_in(4) ? decorated(parallel(2)) : parallel(1);
    trial.plan = scripts_ ? Plan{.kind = "Sequence",
                                 .children = {Plan{.kind = "Script", .code = kStart}, tree},
                                 .memory = true}
                          : tree;
    for (const char* name : {"g0", "g1"}) trial.plan.beside.push_back(barrier(name));
    for (const char* name : {"p", "q"}) {
      trial.plan.beside.push_back(
          {.kind = "resources", .name = name, .increment = one_in(3) ? 0 : 1});
    }
    take_out_lonely_members(trial.plan);
    take_out_unknown_readings(trial.plan);
    trial.leaves = std::move(leaves_);
    trial.facts = std::move(facts_);
    return trial;
  }

 private:
  Plan node(int depth) {
    --budget_;
    Plan plan = depth > 4 || budget_ <= 0 || one_in(4) ? small()
                : one_in(2)                            ? control(depth)
                                                       : decorated(node(depth + 1));
    if (scripts_ && one_in(3)) add_hook(plan);
    return plan;
  }

  Plan small() {
    const int kind = between(0, 9);
    if (kind < 8 && has_leaf_left()) {
      const bool is_action = kind < 6;
      Plan plan{.kind = is_action ? "action" : "condition",
                .name = leaf(is_action),
                .script = is_action ? "R" : "S"};
      if (scripts_) plan.output = output({"x", "y"});
      return plan;
    }
    if (scripts_ && one_in(2)) {
      if (one_in(3)) {
        return {.kind = "WaitUntil", .seconds = one_in(2) ? 0 : seconds(), .code = condition()};
      }
      return one_in(2) ? Plan{.kind = "Script", .code = assignment()}
                       : Plan{.kind = "Check", .code = condition()};
    }
    if (one_in(2)) return {.kind = "Wait", .seconds = seconds()};
    return {.kind = pick(std::array{"AlwaysSuccess", "AlwaysFailure", "AlwaysRunning"})};
  }

  Plan control(int depth) {
    if (one_in(3)) return parallel(depth);
    if (one_in(4)) {
      Plan plan{.kind = one_in(2) ? "IfThenElse" : "WhileDoElse"};
      for (int i = between(2, 3); i > 0; --i) plan.children.push_back(node(depth + 1));
      return plan;
    }
    Plan plan{.kind = one_in(2) ? "Sequence" : "Fallback", .memory = one_in(2)};
    for (int i = between(1, 3); i > 0; --i) plan.children.push_back(node(depth + 1));
    return plan;
  }

  Plan parallel(int depth) {
    Plan plan{.kind = pick(std::array{"Parallel", "ParallelAbsolute", "ParallelRelative"})};
    const int count = between(2, 3);
    for (int i = 0; i < count; ++i) plan.children.push_back(child(depth + 1));
    if (one_in(3)) plan.success_count = between(1, count);
    if (one_in(2)) plan.failure_count = between(1, count);
    plan.forgets = one_in(8);
    if (plan.kind == "ParallelRelative") plan.delta = delta();
    if (plan.kind == "ParallelRelative") plan.holds_between = one_in(3);
    if (plan.kind == "ParallelAbsolute") bars(plan);
    return plan;
  }

  // Most are members of something.
  Plan child(int depth) {
    Plan plan = node(depth);
    if (one_in(8)) plan = decorated(std::move(plan));
    if (one_in(2)) return member(std::move(plan));
    return plan;
  }
  Plan member(Plan child) {
    if (one_in(2)) return in_barrier(std::move(child));
    return in_pool(std::move(child));
  }
  Plan in_barrier(Plan child) {
    return {
        .kind = "SyncProgress", .children = {std::move(child)}, .barrier = one_in(4) ? "g1" : "g0"};
  }
  // A pool may be used inside of those before it.
  Plan in_pool(Plan child) {
    if (uses_pool(child, "p")) return child;
    const bool is_outer = uses_pool(child, "q");
    return {.kind = "UseResources",
            .children = {std::move(child)},
            .pool = is_outer || !one_in(4) ? "p" : "q",
            .resources = pick(std::array{"A", "A", "B", "A;B"}),
            .keep = one_in(3)};
  }
  static bool uses_pool(const Plan& plan, const std::string& pool) {
    return plan.pool == pool ||
           std::ranges::any_of(plan.children, [&](const Plan& it) { return uses_pool(it, pool); });
  }

  Plan decorated(Plan child) {
    if (one_in(4)) return member(std::move(child));
    Plan plan{.kind = pick(std::array{"Inverter", "ForceSuccess", "ForceFailure", "Repeat", "Retry",
                                      "Repeat", "Retry", "Timeout", "Delay", "RunOnce", "Cooldown",
                                      "Rate", "KeepRunningUntilFailure", "SubTree"}),
              .children = {std::move(child)}};
    const bool is_loop = plan.kind == "Repeat" || plan.kind == "Retry";
    if (plan.kind == "Retry" || (is_loop && !one_in(3))) plan.times = between(1, 2);
    plan.seconds = seconds();
    const bool has_clock = plan.kind == "Timeout" || plan.kind == "Delay" || plan.kind == "Rate";
    plan.wall_clock = has_clock && one_in(4);
    return plan;
  }

  double seconds() { return pick(std::array{.1, .2, .3}); }
  double delta() {
    const int steps = parts_ == 0 ? 1 : parts_;
    return static_cast<double>(between(0, steps)) / steps;
  }
  void bars(Plan& plan) {
    plan.has_barriers = true;
    plan.barriers = parts_ == 4 && one_in(2) ? std::vector{.25, .75}
                    : one_in(3)              ? std::vector{.5, 1.0}
                    : one_in(2)              ? std::vector{1.0}
                                             : std::vector{.5};
    plan.tick_at_barrier = one_in(4);
    plan.holds_between = one_in(3);
  }
  Plan barrier(const char* name) {
    Plan plan{.kind = "barrier", .name = name, .ignores_idle = one_in(2)};
    if (one_in(3)) {
      plan.delta = delta();
    } else {
      bars(plan);
    }
    return plan;
  }

  std::string condition() {
    return one_in(2) ? reading() : pick(std::array{"x>0", "x<1", "x==y", "y!=1"});
  }
  std::string reading() {
    const std::string leaf = fmt::format("(a{})", between(0, kMostJudgedLeaves - 1));
    switch (between(0, 5)) {
      case 0:
        return "held" + leaf + pick(std::array{"==true", "==false"});
      case 1:
        return pick(std::array{"owner(p/A)==none", "owner(p/B)!=none", "owner(q/A)==none"});
      case 2:
      case 3:
        return "status" + leaf + pick(std::array{"==running", "==success", "!=failure", "==idle"});
      default:
        return "progress" + leaf + pick(std::array{">=0.5", "<0.5", "==1", ">0", ">=0.25"});
    }
  }
  std::string assignment() { return pick(std::array{"x:=1-x", "x:=0", "x:=1", "y:=x", "y:=1-y"}); }
  void add_hook(Plan& plan) {
    if (one_in(2)) {
      plan.hooks[pick(std::array{"failure_if", "success_if", "skip_if", "while", "while"})] =
          condition();
    } else {
      plan.hooks[pick(std::array{"on_success", "on_failure", "on_end", "on_halt"})] = assignment();
    }
  }

  int budget_ = 0;
  bool scripts_ = false;
};

class SmallDocument : LeafRules {
 public:
  explicit SmallDocument(std::uint64_t seed) : LeafRules(seed) {}

  JudgedTrial trial() {
    scripts_ = one_in(3);
    budget_ = between(4, 14);
    law::Element tree = node(1);
    if (scripts_) tree = {.tag = "Sequence", .children = {script({"n", ":=", "", 0.0}), tree}};
    JudgedTrial trial{.leaves = {}};
    trial.document["Main"] = std::move(tree);
    trial.leaves = std::move(leaves_);
    trial.facts = std::move(facts_);
    return trial;
  }

 private:
  using Element = law::Element;
  static Element script(law::Script code) {
    return {.tag = "Script", .scripts = {{"code", std::move(code)}}};
  }
  law::Script condition() {
    return {"n", pick(std::array{"==", "!=", ">"}), "", static_cast<double>(between(0, 1))};
  }
  law::Script assignment() { return {"n", ":=", "", static_cast<double>(between(0, 2))}; }

  Element node(int depth) {
    --budget_;
    Element it = depth > 4 || budget_ <= 0 || one_in(5) ? small()
                 : one_in(3)                            ? decorated(depth)
                                                        : control(depth);
    if (scripts_ && one_in(4)) {
      it.scripts[pick(std::array{"_failureIf", "_successIf", "_skipIf", "_while"})] = condition();
    }
    if (scripts_ && one_in(6)) {
      it.scripts[pick(std::array{"_onSuccess", "_onFailure", "_post", "_onHalted"})] = assignment();
    }
    return it;
  }

  Element small() {
    const int kind = between(0, 9);
    if (kind < 8 && has_leaf_left()) {
      const bool is_action = kind < 6;
      Element it{.tag = is_action ? "Act" : "Cond",
                 .attributes = {{"name", leaf(is_action)}},
                 .letters = "S"};
      const std::string entry = scripts_ ? output({"n"}) : "";
      if (!entry.empty()) it.attributes["out"] = "{" + entry + "}";
      return it;
    }
    if (scripts_ && one_in(2)) {
      if (one_in(2)) return script(assignment());
      return {.tag = "ScriptCondition", .scripts = {{"code", condition()}}};
    }
    if (one_in(2)) return {.tag = "Sleep", .attributes = {{"msec", milliseconds()}}};
    return {.tag = pick(std::array{"AlwaysSuccess", "AlwaysFailure"})};
  }
  std::string milliseconds() { return std::to_string(100 * between(1, 3)); }

  Element control(int depth) {
    Element it{.tag = pick(std::array{
                   "Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "AsyncSequence",
                   "AsyncFallback", "SequenceWithMemory", "Parallel", "ParallelAll", "Parallel",
                   "ParallelAll", "ParallelAbsolute", "ParallelRelative", "ParallelAbsolute",
                   "ParallelRelative", "IfThenElse", "WhileDoElse"})};
    const bool branches = it.tag == "IfThenElse" || it.tag == "WhileDoElse";
    const int count = between(2, 3);
    for (int i = 0; i < count; ++i) {
      Element child = node(depth + 1);
      it.children.push_back(branches && i == 0 ? safe(std::move(child)) : std::move(child));
    }
    const auto some = [&] { return std::to_string(between(1, count)); };
    const bool is_synchronized = it.tag == "ParallelAbsolute" || it.tag == "ParallelRelative";
    if (it.tag == "Parallel" || is_synchronized) {
      if (one_in(3)) it.attributes["success_count"] = some();
      if (one_in(3)) it.attributes["failure_count"] = some();
    }
    if (it.tag == "ParallelAll" && one_in(2)) it.attributes["max_failures"] = some();
    if (it.tag == "ParallelAbsolute") {
      it.attributes["barriers"] = pick(std::array{"0.5", "1", "0.5;1"});
      if (one_in(4)) it.attributes["at_barrier"] = "tick";
    }
    if (it.tag == "ParallelRelative") it.attributes["delta"] = one_in(2) ? "0" : half();
    if (is_synchronized && one_in(3)) it.attributes["hold"] = "between";
    return it;
  }
  std::string half() const { return parts_ == 0 ? "1" : "0.5"; }
  // A condition that is skipped ends the run.
  static Element safe(Element child) {
    child.scripts.erase("_skipIf");
    child.scripts.erase("_while");
    return child;
  }

  Element decorated(int depth) {
    Element it{.tag = pick(std::array{"Inverter", "ForceSuccess", "ForceFailure",
                                      "KeepRunningUntilFailure", "Repeat", "RetryUntilSuccessful",
                                      "Repeat", "RetryUntilSuccessful", "RunOnce", "Delay",
                                      "Timeout", "Timeout"})};
    if (it.tag == "Repeat") it.attributes["num_cycles"] = std::to_string(between(1, 2));
    if (it.tag == "RetryUntilSuccessful")
      it.attributes["num_attempts"] = std::to_string(between(1, 2));
    if (it.tag == "RunOnce") it.attributes["then_skip"] = one_in(2) ? "true" : "false";
    if (it.tag == "Delay") it.attributes["delay_msec"] = milliseconds();
    if (it.tag == "Timeout") it.attributes["msec"] = milliseconds();
    it.children.push_back(node(depth + 1));
    return it;
  }

  int budget_ = 0;
  bool scripts_ = false;
};

void collect(const Plan& plan, std::vector<std::string>& names) {
  if (!plan.script.empty()) names.push_back(plan.name);
  for (const Plan& child : plan.children) collect(child, names);
}
void collect(const law::Element& element, std::vector<std::string>& names) {
  if (!element.letters.empty()) names.push_back(element.attributes.at("name"));
  for (const law::Element& child : element.children) collect(child, names);
}

// Each element with a child in its place, or without one of its children.
std::vector<law::Element> smaller(const law::Element& element) {
  std::vector<law::Element> all = element.children;
  for (const auto& [name, script] : element.scripts) {
    if (name[0] != '_') continue;
    all.push_back(element);
    all.back().scripts.erase(name);
  }
  const std::size_t least =
      element.tag == "IfThenElse" || element.tag == "WhileDoElse" ? 2 : std::size_t{1};
  for (std::size_t i = 0; i < element.children.size(); ++i) {
    if (element.children.size() > least && !element.attributes.contains("success_count") &&
        !element.attributes.contains("failure_count") &&
        !element.attributes.contains("max_failures")) {
      all.push_back(element);
      all.back().children.erase(all.back().children.begin() + static_cast<std::ptrdiff_t>(i));
    }
    for (law::Element& child : smaller(element.children[i])) {
      all.push_back(element);
      all.back().children[i] = std::move(child);
    }
  }
  return all;
}

}  // namespace

std::string JudgedTrial::text() const {
  return is_btcpp() ? law::to_xml(document) : tree_text(plan);
}

std::vector<LeafRule> JudgedTrial::rules() const {
  std::vector<std::string> names;
  is_btcpp() ? collect(document.at("Main"), names) : collect(plan, names);
  std::vector<LeafRule> rules;
  for (const std::string& name : names)
    rules.push_back(*std::ranges::find(leaves, name, &LeafRule::name));
  return rules;
}

std::string JudgedTrial::rows() const {
  std::string rows;
  constexpr std::array kChanges{"freely", "never", "rises", "falls"};
  for (std::size_t i = 0; i < facts.size(); ++i) {
    rows += fmt::format("<fact name=\"f{}\" changes=\"{}\"/>", i,
                        kChanges[static_cast<std::size_t>(facts[i].changes)]);
  }
  for (const LeafRule& it : rules()) rows += it.row();
  return rows;
}

JudgedTrial judged_trial(std::uint64_t seed) {
  return SmallTree(seed).trial();
}
JudgedTrial judged_btcpp_trial(std::uint64_t seed) {
  return SmallDocument(seed).trial();
}

std::vector<JudgedTrial> smaller(const JudgedTrial& trial) {
  std::vector<JudgedTrial> all;
  if (trial.is_btcpp()) {
    for (law::Element& main : smaller(trial.document.at("Main"))) {
      all.push_back(trial);
      all.back().document["Main"] = std::move(main);
    }
  } else {
    for (Trial& it : smaller_trials({.plan = trial.plan})) {
      all.push_back(trial);
      all.back().plan = std::move(it.plan);
    }
  }
  for (std::size_t i = 0; i < trial.leaves.size(); ++i) {
    const auto with = [&](auto change) {
      LeafRule rule = trial.leaves[i];
      change(rule);
      if (rule.row() == trial.leaves[i].row()) return;
      all.push_back(trial);
      all.back().leaves[i] = rule;
    };
    with([](LeafRule& it) { it.skips = false; });
    with([](LeafRule& it) { it.least_drift = it.most_drift = 0; });
    with([](LeafRule& it) { it.fails = it.fails && !it.succeeds; });
    with([](LeafRule& it) { it.finishes_full = false; });
    with([](LeafRule& it) { it.fact = -1; });
    with([](LeafRule& it) { it.sets = -1; });
    with([](LeafRule& it) { it.writes = LeafRule::Writes::WithSuccess; });
    with([](LeafRule& it) {
      it.parts = it.least_step = it.most_step = 0;
      it.finishes_full = false;
    });
    with([](LeafRule& it) {
      if (!it.finishes_full) it.least_ticks = it.most_ticks = 1;
    });
  }
  return all;
}

}  // namespace lockstep::host::test
