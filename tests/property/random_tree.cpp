#include "property/random_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/random.h"
#include "support/leaf_script.h"

namespace lockstep::test {
namespace {

constexpr int kMaxDepth = 6;
constexpr auto kStart = "x:=0;y:=1";  // what gives all entries of scripts a value
constexpr std::array kFractions{.1, .2, .25, .3, .4, .5, .6, .7, .75, .8, .9, 1.0};

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed, 0) {}
  int between(int low, int high) {
    return low + static_cast<int>(random_.next() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int count) { return between(1, count) == 1; }
  template <class List>
  auto pick(const List& list) {
    return list[static_cast<std::size_t>(between(0, static_cast<int>(list.size()) - 1))];
  }

 private:
  RandomStream random_;
};

class Generator : Random {
 public:
  explicit Generator(std::uint64_t seed) : Random(seed) {}

  Trial trial() {
    Trial trial;
    budget_ = between(1, one_in(4) ? 40 : 14);
    faults_ = one_in(3);
    skips_ = one_in(2);
    scripts_ = one_in(2);
    trial.plan = scripts_ ? with_entries(node(1)) : node(1);
    trial.plan.beside = {barrier("g0"), barrier("g1"), pool("p"), pool("q")};
    trial.period = pick(std::array{.1, .05, .13, 1.0});
    trial.ticks = between(5, 60);
    trial.halt_every = one_in(3) ? between(2, 15) : 0;
    trial.watched = one_in(2);
    return trial;
  }

 private:
  double fraction() { return pick(kFractions); }

  // The entries of all scripts have a value first.
  static Plan with_entries(Plan plan) {
    return Plan{.kind = "Sequence",
                .children = {Plan{.kind = "Script", .code = kStart}, std::move(plan)},
                .memory = true};
  }

  Plan node(int depth) {
    Plan plan = bare_node(depth);
    if (scripts_ && plan.kind != "bare") add_hooks(plan);
    return plan;
  }

  std::string condition() {
    return pick(std::array{"x>0", "x<2", "x==y", "y!=1", "x>=y", "x<3", "y<4"});
  }
  std::string assignment() {
    return pick(std::array{"x+=1", "x:=0", "y:=1", "y:=x", "x:=1-x", "y:=3-y", "y+=1", "x:=y-x"});
  }

  void add_hooks(Plan& plan) {
    // These have a result that only a script gives.
    const bool needs_it = plan.kind == "AlwaysRunning" || plan.kind.starts_with("Force") ||
                          plan.kind == "KeepRunningUntilFailure";
    for (const char* hook : {"failure_if", "success_if", "skip_if", "while"}) {
      if (one_in(needs_it ? 3 : 10)) plan.hooks[hook] = condition();
    }
    for (const char* hook : {"on_success", "on_failure", "on_end", "on_halt"}) {
      if (one_in(10)) plan.hooks[hook] = assignment();
    }
  }

  Plan bare_node(int depth) {
    --budget_;
    if (depth == kMaxDepth || budget_ <= 0 || (depth > 1 && one_in(4))) return leaf();
    switch (between(0, 12)) {
      case 12:
        return cases(depth);
      case 10:
        return branches("IfThenElse", depth);
      case 11:
        return branches("WhileDoElse", depth);
      case 0:
      case 1:
        return control("Sequence", depth);
      case 2:
        return control("Fallback", depth);
      case 3:
        return control("Parallel", depth);
      case 4:
      case 5:
        return control("ParallelAbsolute", depth);
      case 6:
      case 7:
        return control("ParallelRelative", depth);
      default:
        return decorator(depth);
    }
  }

  Plan control(std::string kind, int depth) {
    Plan plan{.kind = std::move(kind)};
    const int children = between(1, 4);
    const bool is_parallel = plan.kind.starts_with("Parallel");
    for (int i = 0; i < children; ++i) {
      const bool shares = is_parallel && !inside_q_ && one_in(4);
      plan.children.push_back(is_parallel && one_in(5) ? guard(depth + 1)
                              : shares                 ? use_resources(depth + 1)
                                                       : node(depth + 1));
    }
    if (!is_parallel) plan.memory = one_in(2);
    if (is_parallel && one_in(6)) plan.forgets = true;
    if (is_parallel && one_in(2)) plan.success_count = between(1, children);
    if (is_parallel && one_in(2)) plan.failure_count = between(1, children);
    if (plan.kind == "ParallelRelative") plan.delta = one_in(4) ? between(0, 1) : fraction();
    if (plan.kind == "ParallelAbsolute") barriers(plan);
    return plan;
  }

  Plan branches(std::string kind, int depth) {
    Plan plan{.kind = std::move(kind)};
    plan.children.push_back(one_in(3) ? node(depth + 1) : guard(depth + 1));
    for (int i = between(1, 2); i > 0; --i) plan.children.push_back(node(depth + 1));
    return plan;
  }

  Plan cases(int depth) {
    Plan plan{.kind = "Switch"};
    plan.code = scripts_ ? pick(std::array{"x", "y", "x+y"}) : pick(std::array{"1", "2"});
    const int count = between(1, 3);
    for (int i = 0; i < count; ++i) plan.cases.push_back(std::to_string(i));
    for (int i = count + between(0, 1); i > 0; --i) plan.children.push_back(node(depth + 1));
    return plan;
  }

  // A subtree without actions.
  Plan guard(int depth) {
    --budget_;
    if (scripts_ && one_in(3)) return Plan{.kind = "Check", .code = condition()};
    if (depth >= kMaxDepth || !one_in(3)) return scripted("condition");
    Plan plan{.kind = pick(std::array{"Sequence", "Fallback", "Parallel", "Inverter", "Delay",
                                      "Repeat", "SubTree", "Rate", "Cooldown"})};
    const bool is_control =
        plan.kind == "Sequence" || plan.kind == "Fallback" || plan.kind == "Parallel";
    for (int i = is_control ? between(1, 3) : 1; i > 0; --i) {
      plan.children.push_back(guard(depth + 1));
    }
    if (plan.kind == "Repeat") plan.times = between(1, 3);
    plan.seconds = .05 * between(0, 10);
    return plan;
  }

  void barriers(Plan& plan) {
    plan.tick_at_barrier = one_in(3);
    if (one_in(3)) {
      plan.barrier_count = between(0, 5);
      return;
    }
    plan.has_barriers = true;
    for (const double value : kFractions) {
      if (one_in(4)) plan.barriers.push_back(value);
    }
  }

  Plan barrier(std::string name) {
    Plan plan{.kind = "barrier", .name = std::move(name)};
    plan.ignores_idle = one_in(2);
    if (one_in(2)) {
      barriers(plan);
    } else {
      plan.delta = one_in(4) ? between(0, 1) : fraction();
    }
    return plan;
  }

  Plan pool(std::string name) {
    Plan plan{.kind = "resources", .name = std::move(name)};
    plan.increment = between(0, 2);
    return plan;
  }

  // The pool q may be used inside of p, else no member is inside of another one.
  Plan use_resources(int depth) {
    Plan plan{.kind = "UseResources"};
    plan.pool = inside_p_ || one_in(3) ? "q" : "p";
    plan.resources = pick(std::array{"A", "B", "C", "A;B", "B;C", "A;C", "A;B;C"});
    plan.keep = one_in(4);
    bool& inside = plan.pool == "q" ? inside_q_ : inside_p_;
    inside = true;
    plan.children.push_back(node(depth + 1));
    inside = false;
    return plan;
  }

  Plan decorator(int depth) {
    if (!inside_q_ && one_in(3)) return use_resources(depth);
    Plan plan{.kind = pick(std::array{"Inverter", "ForceSuccess", "ForceFailure", "Repeat",
                                      "Repeat", "Retry", "Timeout", "Delay", "RunOnce", "Cooldown",
                                      "Rate", "KeepRunningUntilFailure", "SubTree", "SyncProgress",
                                      "SyncProgress", "SyncProgress", "SyncProgress"})};
    if (plan.kind == "SyncProgress") {
      plan.barrier = one_in(4) ? "g1" : "g0";
    }
    plan.children.push_back(node(depth + 1));
    if (plan.kind == "Retry" || (plan.kind == "Repeat" && !one_in(4))) plan.times = between(1, 4);
    plan.seconds = .05 * between(plan.kind == "Timeout" ? 1 : 0, 20);
    const bool has_clock = plan.kind == "Timeout" || plan.kind == "Delay" || plan.kind == "Rate";
    plan.wall_clock = has_clock && one_in(3);
    return plan;
  }

  Plan leaf() {
    if (scripts_ && one_in(5)) {
      return one_in(2) ? Plan{.kind = "Script", .code = assignment()}
                       : Plan{.kind = "Check", .code = condition()};
    }
    switch (between(0, 19)) {
      case 0:
        return Plan{.kind = "AlwaysSuccess"};
      case 1:
        return one_in(2) ? Plan{.kind = "AlwaysFailure"} : Plan{.kind = "AlwaysRunning"};
      case 2:
      case 3:
        return Plan{.kind = "Wait", .seconds = .05 * between(0, 20)};
      case 4:
      case 5:
        return scripted("condition");
      case 6:
        return scripted("bare");
      default:
        return scripted("action");
    }
  }

  // The letters of the results that end an activation.
  std::string results() const { return skips_ ? "SSFFK" : "SF"; }

  Plan scripted(std::string kind) {
    const std::string name = fmt::format("a{}", leaves_++);
    std::string script;
    if (kind == "condition")
      script = steps(results(), 4);
    else if (!one_in(3))
      script = one_in(2) ? growth() : steps("RRRRS" + results(), 10);
    else
      script = one_in(2) ? "R" + live() : steps("RRRRRRRR" + results(), 12) + live();
    if (faults_ && one_in(4)) script = fault(script);
    return Plan{.kind = std::move(kind), .name = name, .script = std::move(script)};
  }

  std::string progress() {
    // Two decimals, so that the number cannot run into the dots of a repeated script.
    return fmt::format("{:.2f}", one_in(10)  ? pick(std::array{-.5, 1.5, 1.0})
                                 : one_in(5) ? 0.0
                                             : fraction());
  }

  std::string growth() {
    if (one_in(2)) return fmt::format("+{}", pick(std::array{.05, .1, .2, .25, .3, .5}));
    return fmt::format("+{},-{},{}", fraction(), pick(std::array{.1, .2, .3}), fraction() / 2);
  }

  std::string steps(std::string_view letters, int longest) {
    std::string text;
    for (int count = between(1, longest); count > 0; --count) {
      text += pick(letters);
      if (!one_in(4)) text += progress();
    }
    return text + "...";
  }

  std::string live() {
    std::string text;
    for (int count = between(2, 40); count > 0; --count) {
      text += (text.empty() ? "~" : ",") + (one_in(2) ? std::to_string(between(0, 1)) : progress());
    }
    return text;
  }

  std::string fault(const std::string& script) {
    constexpr std::array kWrong{"X", "T",      "B",      "I",      "x",
                                "t", "R<nan>", "R<nan>", "R<nan>", "R<nan>"};
    constexpr std::array kCalls{"!halt", "^halt", "!pause", "^pause", "!resume", "^resume"};
    if (one_in(2)) return script + pick(kCalls);
    if (script[0] == '+') return steps("R", 10) + pick(kCalls);
    return (script[0] == 'R' ? "R" : "S") + std::string(pick(kWrong)) + script;
  }

  int budget_ = 0;
  int leaves_ = 0;
  bool faults_ = false;
  bool skips_ = false;    // leaves may return Skipped
  bool scripts_ = false;  // there are scripts
  bool inside_p_ = false, inside_q_ = false;
};

// Its scripts need what its first child does.
bool gives_entries(const Plan& plan) {
  return !plan.children.empty() && plan.children[0].code == kStart;
}

// Each plan that comes from taking a child away or putting a child in its parent's place.
void add_smaller_plans(const Plan& plan, std::vector<Plan>& plans) {
  for (const auto& [attribute, script] : plan.hooks) {
    plans.push_back(plan);
    plans.back().hooks.erase(attribute);
  }
  for (std::size_t i = 0; i < plan.children.size(); ++i) {
    plans.push_back(plan.children[i]);
    const bool has_branches = plan.kind == "IfThenElse" || plan.kind == "WhileDoElse";
    if (plan.kind != "Switch" && plan.children.size() > (has_branches ? 2 : 1)) {
      Plan fewer = plan;
      fewer.children.erase(fewer.children.begin() + static_cast<std::ptrdiff_t>(i));
      const int left = static_cast<int>(fewer.children.size());
      fewer.success_count = std::min(fewer.success_count, left);
      fewer.failure_count = std::min(fewer.failure_count, left);
      plans.push_back(fewer);
    }
    std::vector<Plan> deeper;
    add_smaller_plans(plan.children[i], deeper);
    for (Plan& child : deeper) {
      Plan changed = plan;
      changed.children[i] = std::move(child);
      plans.push_back(std::move(changed));
    }
  }
}

}  // namespace

Trial random_trial(std::uint64_t seed) {
  return Generator(seed).trial();
}

std::vector<Trial> smaller_trials(const Trial& trial) {
  std::vector<Plan> plans;
  add_smaller_plans(trial.plan, plans);
  std::vector<Trial> trials;
  for (Plan& plan : plans) {
    if (gives_entries(trial.plan) && !gives_entries(plan)) continue;
    plan.beside = trial.plan.beside;
    trials.push_back(trial);
    trials.back().plan = std::move(plan);
  }
  if (trial.halt_every != 0) {
    trials.push_back(trial);
    trials.back().halt_every = 0;
  }
  return trials;
}

}  // namespace lockstep::test
