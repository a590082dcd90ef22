#include "verify/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/wording.h"
#include "judge/measure/stall.h"
#include "judge/measure/wait_chain.h"
#include "judge/summary/standstill_text.h"
#include "run/live_moments.h"

namespace lockstep::host {
namespace {

// Members of a pool that wait for each other, each with what another one needs.
std::vector<std::string> circle_of_a_pool(const Shape& shape, const Moment& moment) {
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    if (!shape.nodes[node].is_pool() || !holds_somebody(shape, moment, node)) continue;
    const WaitChain chain = wait_chain(shape, moment, node);
    if (chain.obstacle == Obstacle::Circle) return wait_lines(shape, chain);
  }
  return {};
}

}  // namespace

std::vector<std::string> Explainer::why_it_stands(const Finding& finding) {
  std::vector<std::string> lines = standstill_of(finding);
  if (lines.empty()) lines.push_back(who_is_ticked(finding));
  return lines;
}

std::vector<std::string> Explainer::standstill_of(const Finding& finding) {
  std::vector<std::string> lines;
  const Shape shape = shape_of(tree_);
  LiveMoments moments(tree_);
  StallWatch watch(shape, deadlines_.at(1) / 2, [&](const Standstill& standstill) {
    lines = standstill_lines(shape, standstill);
  });
  TracedRun run = finding.run;
  if (finding.repeats) {
    const std::size_t round = finding.round();
    while (run.size() < *finding.repeats + 8) {
      const TracedRun more(run.end() - static_cast<std::ptrdiff_t>(round), run.end());
      run.insert(run.end(), more.begin(), more.end());
    }
  }
  tracer_.play(run, [&](Stepper& stepper, Status status, std::size_t tick) {
    if (status != Status::Running) return;
    const Moment& moment = moments.after_tick(stepper.ticker(), tick, deadlines_.at(tick));
    watch.after_tick(moment);
    if (tick + 1 == run.size() && lines.empty()) lines = circle_of_a_pool(shape, moment);
  });
  // When it began is that of this one run.
  for (std::string& line : lines) {
    const auto since = line.find(" since ");
    if (since == std::string::npos) continue;
    const auto end = line.find(" s", since + 7);
    if (end != std::string::npos) line.erase(since, end + 2 - since);
  }
  return lines;
}

// The leaves that work in the cycle.
std::string Explainer::who_is_ticked(const Finding& finding) {
  std::set<std::string> worked;
  tracer_.play(finding.run, [&](Stepper& stepper, Status, std::size_t tick) {
    if (!finding.repeats || tick < *finding.repeats) return;
    const auto marks = stepper.leaves().marks();
    for (std::size_t leaf = 0; leaf < marks.size(); ++leaf) {
      if (marks[leaf].ticked) worked.insert(tree_.path(tree_.leaves[leaf].node));
    }
  });
  if (worked.empty()) return "no leaf of a plugin gets ticks";
  return "what gets ticks: " + some_of(worked, kMostNamesInLine);
}

std::string Explainer::what_happens(const Finding& finding) {
  std::vector<std::string> events;
  tracer_.play(finding.run, [&](Stepper& stepper, Status, std::size_t tick) {
    const std::size_t round = finding.round();
    if (tick < *finding.repeats || tick >= *finding.repeats + round) return;
    for (std::string& event : ends_in(stepper)) {
      if (std::ranges::find(events, event) == events.end()) events.push_back(std::move(event));
    }
  });
  return events.empty() ? who_is_ticked(finding) : "in it: " + some_of(events, kMostNamesInLine);
}

// The leaves that a tick ends, and how.
std::vector<std::string> Explainer::ends_in(const Stepper& stepper) const {
  const MomentsView moments = stepper.ticker().moments();
  return moments.empty() ? ends_by_marks(stepper) : ends_in(moments, stepper);
}

// A leaf may end several times.
std::vector<std::string> Explainer::ends_in(const MomentsView& moments,
                                            const Stepper& stepper) const {
  std::vector<std::string> events;
  const auto add = [&](NodeIndex node, std::string_view what) {
    events.push_back(tree_.path(node) + ' ' + std::string(what));
  };
  std::vector<NodeState> before, moment;
  for (const Activity it : stepper.before().run.activity) {
    before.push_back(NodeState::of(it, false));
  }
  moments.each(moment, [&](std::span<const NodeState> now, const TickMoment&, bool) {
    for (const LeafNode& leaf : tree_.leaves) {
      const NodeState it = now[leaf.node];
      const bool ran = before[leaf.node].status() == Status::Running;
      if (it.ticked() && has_ended(it.status())) add(leaf.node, row_of(it.status()).counted);
      if (ran && it.status() == Status::Idle) add(leaf.node, "is halted");
    }
    before.assign(now.begin(), now.end());
  });
  return events;
}

std::vector<std::string> Explainer::ends_by_marks(const Stepper& stepper) const {
  std::vector<std::string> events;
  const auto marks = stepper.leaves().marks();
  for (std::size_t leaf = 0; leaf < marks.size(); ++leaf) {
    if (!marks[leaf].ended) continue;
    const std::string path = tree_.path(tree_.leaves[leaf].node);
    events.push_back(has_ended(marks[leaf].result)
                         ? path + ' ' + std::string(row_of(marks[leaf].result).counted)
                         : path + " is halted");
  }
  return events;
}

std::string Explainer::last_tick_of(const Finding& finding) {
  std::vector<std::string> events;
  bool is_end = false;
  tracer_.play(finding.run, [&](Stepper& stepper, Status status, std::size_t tick) {
    if (tick + 1 != finding.run.size()) return;
    events = ends_in(stepper);
    const auto marks = stepper.leaves().marks();
    for (std::size_t leaf = 0; leaf < marks.size(); ++leaf) {
      if (!marks[leaf].ticked || marks[leaf].ended) continue;
      events.push_back(tree_.path(tree_.leaves[leaf].node) + " runs");
    }
    is_end = status != Status::Running;
  });
  if (events.empty()) events.emplace_back("no leaf of a plugin gets ticks");
  return fmt::format("in tick {}{}: {}", finding.run.size() - 1,
                     is_end ? ", in which the run ends" : "", some_of(events, kMostNamesInLine));
}

}  // namespace lockstep::host
