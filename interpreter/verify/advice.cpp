#include "verify/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/core/wording.h"
#include "engine/resources.h"
#include "engine/synchronized.h"
#include "engine/writers.h"
#include "judge/summary/standstill_text.h"
#include "run/shape_of.h"
#include "verify/certain.h"
#include "verify/chance_runs.h"
#include "verify/deadlocks.h"
#include "verify/labels.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

// The same on every machine, and some hundredths of a second.
constexpr std::size_t kMostNodes = 10'000, kMostStops = 100'000;

SearchLimits bound(const Tree& tree, std::uint64_t transitions) {
  return {
      .states = 20'000,
      .transitions = std::min<std::uint64_t>(transitions, 200 * transitions / tree.nodes.size()),
      .memory = std::numeric_limits<std::size_t>::max()};
}
constexpr std::uint64_t kOfCertainties = 10'000, kOfSkipped = 200'000, kOfDeadlocks = 20'000,
                        kOfRun = 1'000;

// The rate decides what comes first, but not in the first tick, nor where no node counts time.
bool depends_on_rate(const Tree& tree, const SearchResult& found) {
  const auto counts_time = [&](NodeIndex node) {
    const NodeType& type = *tree.labels[node].type;
    return type.leaf == nullptr && type.mock == nullptr &&
           std::ranges::any_of(type.parameters,
                               [](const Parameter& it) { return !it.unit.empty(); });
  };
  if (found.store.size() == 1) return false;
  for (NodeIndex node = 0; node < tree.nodes[0].end; ++node) {
    if (counts_time(node) && found.coverage.was_ticked(node)) return true;
  }
  return false;
}

// Whoever starts the tree may give the entries of the main tree other start values.
bool has_start_values(const Tree& tree, const LeafModels& models) {
  const auto written = writers(tree);  // by the tree itself, or by its leaves
  for (std::size_t slot = 0; slot < tree.slots.size(); ++slot) {
    if (tree.slots[slot].name.find('/') != std::string_view::npos) continue;
    const bool has_value = !std::holds_alternative<NoValue>(tree.slots[slot].initial);
    if (models.entries[slot] && (has_value || written[slot].empty())) return true;
  }
  return false;
}

// --- deadlocks -----------------------------------------------------------------------------------

// Where a delta holds depends on how far others are: with a delta of 0.2 beyond 0.95, if they wait
// at a barrier at 0.75. So steps are small there.
void make_steps_small(LeafModel& leaf) {
  constexpr double kStep = 0.02;
  std::vector<double> levels;
  for (std::size_t i = 0; i < leaf.levels.size(); ++i) {
    const double next = i + 1 < leaf.levels.size() ? leaf.levels[i + 1] : 1;
    const auto count = std::ceil((next - leaf.levels[i]) / kStep - kProgressEpsilon);
    const double step = (next - leaf.levels[i]) / count;
    for (double at = 0; at < count; ++at) levels.push_back(leaf.levels[i] + at * step);
  }
  leaf.levels = std::move(levels);
  leaf.steps.resize(leaf.levels.size());
  std::iota(leaf.steps.begin(), leaf.steps.end(), 0);
  leaf.last_step = leaf.steps.back();
  leaf.goal = static_cast<std::int32_t>(leaf.levels.size());
}

// A leaf that is at 1 has succeeded. One that still runs then may wait for ever where others never
// do, which is rare enough to leave it to `verify`.
LeafModels done_at_1(LeafModels models) {
  for (LeafModel& leaf : models.leaves) {
    if (leaf.levels.back() < 1) continue;
    leaf.levels.pop_back();
    leaf.steps.pop_back();
    leaf.last_step = std::min(leaf.last_step, leaf.steps.back());
  }
  return models;
}

// What a search of all behaviors does not come to is looked at with leaves of which each comes on
// by one small step in each tick and then succeeds. They have next to no choice, so even a large
// tree has few states. For example, in a Sequence of 20 actions below a barrier.
LeafModels steady(LeafModels models) {
  for (LeafModel& leaf : models.leaves) {
    if (!leaf.can_run || !leaf.results.success) continue;
    leaf.results = {.success = true, .failure = false};
    leaf.answers_late = false;
    leaf.least_ticks = std::max<std::int64_t>(leaf.least_ticks, leaf.has_progress ? 1 : 2);
    if (!leaf.has_progress) leaf.most_ticks = leaf.least_ticks;
    leaf.finishes_full = true;
    if (leaf.least_step > 1 || leaf.most_step < 1) continue;
    leaf.least_step = leaf.most_step = 1;
    if (leaf.parts != 0) make_steps_small(leaf);
  }
  return models;
}

// All that the contract allows but Skipped.
void make_general(LeafModel& leaf) {
  leaf.writes = Writes::InAnyCall;
  const auto all = static_cast<std::int64_t>(leaf.levels.size());
  if (leaf.has_progress) {
    leaf.least_step = leaf.least_drift = -all;
    leaf.most_drift = all;
  }
}

class DeadlockText {
 public:
  explicit DeadlockText(const Tree& tree) : tree_(tree) {}

  Advice advice(const Deadlock& deadlock) const {
    const WaitChain& chain = deadlock.chain;
    if (chain.obstacle == Obstacle::Circle) return circle(chain);
    return chain.obstacle == Obstacle::Idle && tree_.is_group(chain.links.back().node)
               ? idle(chain.links.back(), deadlock.decider)
               : hold(chain);
  }

  std::string explained(const WaitChain& chain) const {
    constexpr std::size_t kMostExplained = 4;
    std::vector<std::string> lines = wait_lines(shape_of(tree_), chain);
    lines.resize(std::min(lines.size(), kMostExplained));
    return joined(lines, "; ");
  }

 private:
  Advice circle(const WaitChain& chain) const {
    std::vector<std::string_view> names;
    for (const WaitLink& link : chain.links) names.push_back(tree_.labels[link.node].name);
    names.push_back(names.front());
    return {"deadlock"_code, chain.links.front().waiting, Severity::Warning,
            fmt::format("held nodes may deadlock: {}", chained(names)), explained(chain)};
  }

  Advice idle(const WaitLink& link, NodeIndex decider) const {
    return {"waits-for-idle"_code, link.awaited, Severity::Note,
            fmt::format("the others at '{}' wait for '{}' indefinitely if '{}' does not run it",
                        name(link.node), name(link.awaited), name(decider)),
            "idle=\"ignore\" waits only for members that run"};
  }

  Advice hold(const WaitChain& chain) const {
    const WaitLink& first = chain.links.front();
    return {
        "endless-pause"_code, first.waiting, Severity::Note,
        fmt::format("'{}' may be held by '{}' indefinitely", name(first.waiting), name(first.node)),
        explained(chain)};
  }

  std::string name(NodeIndex node) const { return brief(tree_.labels[node].name); }

  const Tree& tree_;
};

class Adviser {
 public:
  Adviser(const Tree& tree, std::span<const Place> places, std::function<int()> stop_signal)
      : tree_(tree), places_(places), stop_signal_(std::move(stop_signal)) {}

  std::vector<Advice> advise(AdviceEffort effort) {
    if (is_too_large() || !not_verifiable(tree_).empty()) return {};
    if (effort == AdviceEffort::Certain) look_for_certainties();
    const bool holds = std::ranges::any_of(holdable(tree_), [&](const Holdable& it) {
      return !is_pool(tree_, it.holder) || exchanges(tree_, it.child - 1);
    });
    if (holds && !stands_still_) look_for_deadlocks(effort);
    if (stop_signal_ && stop_signal_() != 0) return {};
    return std::move(advice_);
  }

 private:
  // A leaf may stop at each barrier, of which a list may have 100,000.
  bool is_too_large() const {
    if (tree_.nodes.size() > kMostNodes) return true;
    std::size_t barriers = 0;
    for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
      const auto list = host::barriers(tree_, node);
      if (list) barriers += list->size();
    }
    return barriers * tree_.leaves.size() > kMostStops;
  }

  std::optional<LeafModels> models(Declared declared) {
    std::vector<NodeProblem> problems;
    LeafModels models = make_models(tree_, nullptr, unused_, problems, {}, declared);
    std::size_t stops = 0;  // also those of a grid, for a small delta
    for (const LeafModel& leaf : models.leaves) stops += leaf.levels.size();
    if (!problems.empty() || stops > kMostStops) return std::nullopt;
    return models;
  }

  SearchResult search(const LeafModels& models, std::uint64_t transitions, bool cycles) const {
    SearchLimits limits = bound(tree_, transitions);
    limits.stop_signal = stop_signal_;
    limits.cycles = cycles;
    limits.joins = false;  // that is work which no limit of a short search counts
    const bool writes_idle = std::ranges::any_of(models.leaves, [](const LeafModel& it) {
      return it.writes == Writes::InAnyCall && !it.outputs.empty();
    });
    if (writes_idle) limits.few_ticks = kAllTicks;  // points are in ticks of leaves
    return host::search(tree_, models, {}, kModelRate, limits);
  }

  // A few are enough to say nothing false; their number is the same on every machine.
  bool is_wrong(const LeafModels& models, const SearchResult& found) const {
    const ChanceLimits few{.runs = std::clamp<std::uint64_t>(10'000 / tree_.nodes.size(), 2, 30),
                           .time = Nanoseconds::max()};
    return find_contradiction(tree_, models, {}, kModelRate, found, few).has_value();
  }

  // Few leaves return Skipped, lose progress, move while they are held, or write when they get no
  // tick, and nearly all trees are larger with those. So this is looked at only where there is
  // something to say. Without Skipped it is said with that premise.
  void look_for_certainties() {
    auto models = this->models(Declared::Ignored);
    if (!models || has_start_values(tree_, *models)) return;
    if (certainties(*models, kOfCertainties, Results::NotSkipped).empty()) return;
    for (LeafModel& it : models->leaves) make_general(it);
    std::vector<Advice> likely = certainties(*models, kOfSkipped, Results::NotSkipped);
    if (likely.empty()) return;
    for (LeafModel& it : models->leaves) it.results.skipped = true;
    std::vector<Advice> certain = certainties(*models, kOfSkipped, Results::All);
    stands_still_ = is_about(likely.back(), "deadlock");
    // That it never ends is certain; only how has the premise.
    if (stands_still_ && !certain.empty() && is_about(certain.back(), "endless-tree")) {
      likely.back().severity = Severity::Warning;
      certain.pop_back();
    }
    std::erase_if(likely, [&](const Advice& it) {
      return std::ranges::any_of(certain, [&](const Advice& other) {
        return is_about(other, it.code.text()) && other.node == it.node;
      });
    });
    std::ranges::move(certain, std::back_inserter(advice_));
    std::ranges::move(likely, std::back_inserter(advice_));
  }

  static bool is_about(const Advice& it, std::string_view code) { return it.code.text() == code; }

  std::vector<Advice> certainties(const LeafModels& models, std::uint64_t transitions,
                                  Results results) const {
    const SearchResult found = search(models, transitions, true);
    if (!found.is_complete() || depends_on_rate(tree_, found)) return {};
    const NoEnd still = why_no_end(tree_, models, kModelRate, found);
    auto certain =
        host::certainties(tree_, places_, found, results, still.is_everywhere,
                          still.nearest ? DeadlockText(tree_).explained(still.nearest->chain) : "");
    if (!certain.empty() && is_wrong(models, found)) certain.clear();
    return certain;
  }

  void look_for_deadlocks(AdviceEffort effort) {
    auto declared = models(Declared::Counts);
    if (!declared) return;
    const LeafModels models = done_at_1(*std::move(declared));
    const bool is_exact = std::ranges::all_of(models.leaves, [](const auto& it) {
      return it.parts == 0;  // no grid, between the levels of which there may be more
    });
    const bool is_run = effort == AdviceEffort::Run;
    const bool is_known = !is_run && look_for_deadlocks(models, kOfDeadlocks) && is_exact;
    if (!is_known) look_for_deadlocks(steady(models), is_run ? kOfRun : kOfDeadlocks);
  }

  // Whether it has looked at all behaviors.
  bool look_for_deadlocks(const LeafModels& models, std::uint64_t transitions) {
    const SearchResult found = search(models, transitions, false);
    const auto deadlocks = host::deadlocks(tree_, models, kModelRate, found);
    if (!deadlocks.empty() && is_wrong(models, found)) return true;
    for (const Deadlock& it : deadlocks) {
      Advice advice = DeadlockText(tree_).advice(it);
      const auto is_same = [&](const Advice& other) { return other.message == advice.message; };
      if (std::ranges::none_of(advice_, is_same)) advice_.push_back(std::move(advice));
    }
    return found.is_complete();
  }

  const Tree& tree_;
  const std::span<const Place> places_;
  const std::function<int()> stop_signal_;
  bool stands_still_ = false;
  std::vector<Advice> advice_;
  Diagnostics unused_;
};

}  // namespace

std::vector<Advice> advice_of(const Tree& tree, std::span<const Place> places, AdviceEffort effort,
                              std::function<int()> stop_signal) {
  return Adviser(tree, places, std::move(stop_signal)).advise(effort);
}

}  // namespace lockstep::host
