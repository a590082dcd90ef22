#include "scenario/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/core/progress.h"
#include "base/core/wording.h"
#include "judge/measure/decision.h"
#include "judge/measure/measure_spec.h"
#include "language/property/nearly.h"
#include "run/shape_of.h"
#include "study/run_measures.h"

namespace lockstep::host {
namespace {

using Kind = Expectation::Kind;

std::string in_last_tick(const RunEnd& end) {
  return end.ticks == 0 ? "before the first tick" : fmt::format("in tick {}", end.ticks - 1);
}

std::string range_text(const NumberRange& range) {
  if (!range.most) return fmt::format("{} or more", range.least);
  if (*range.most == range.least) return fmt::format("{}", range.least);
  return fmt::format("{} to {}", range.least, *range.most);
}

bool is_within(double value, const NumberRange& range) {
  return value >= range.least - kProgressEpsilon &&
         (!range.most || value <= *range.most + kProgressEpsilon);
}

}  // namespace

std::string_view result_text(const RunEnd& end) {
  constexpr std::string_view kTexts[] = {"success", "failure", "running", "fault", "skipped"};
  return kTexts[static_cast<std::size_t>(end.result())];
}

Judge::Judge(const BoundScenario& bound, const Tree& tree, std::vector<Property> properties)
    : bound_(bound), tree_(tree), checks_(std::move(properties)), steps_(checks_) {}

void Judge::after_tick(const Moment& moment, const TickReport& report) {
  ticks_ = report.tick + 1;
  for (const std::size_t it : steps_.after_tick(moment)) {
    tell_violated(it, fmt::format("in tick {}", report.tick), moment);
  }
  running_.clear();
  if (has_ended(report.status)) {
    for (const DecidingNode& it : deciding_path(shape_of(tree_), moment)) {
      decided_.push_back(tree_.path(it.node));
    }
  } else if (report.tick + 1 >= bound_.scenario->max_ticks.value_or(kMostScenarioTicks)) {
    for (const LeafNode& leaf : tree_.leaves) {
      if (moment.status(leaf.node) != Status::Running) continue;
      running_.push_back(tree_.path(leaf.node) + (moment.held(leaf.node) ? " (held)" : ""));
    }
  }
}

// The end, before what runs is halted. That of a scenario is that of its run, also when a limit has
// ended it.
void Judge::standing(const Moment& moment) {
  for (const std::size_t it : checks_.end(RunIsOver::ByItself)) {
    tell_violated(it,
                  ticks_ == 0 ? std::string("before the first tick")
                              : fmt::format("at the end, in tick {}", ticks_ - 1),
                  moment);
  }
}

void Judge::tell_violated(std::size_t property, const std::string& when, const Moment& moment) {
  const PreparedProperty& it = bound_.properties[property];
  Surprise surprise{.place = it.of->place,
                    .message = fmt::format("'{}' is violated {}", it.property.text(), when)};
  const std::span<const SeenNode> seen = checks_.seen_by(property);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    surprise.more.push_back(fmt::format("{}: {}{}", tree_.path(it.property.nodes()[i]),
                                        to_string(seen[i].status), seen[i].held ? ", held" : ""));
  }
  for (const EntryComparison& comparison : it.property.comparisons()) {
    const Entry& entry = moment.entries[comparison.entry];
    surprise.more.push_back(fmt::format(
        "{{{}}} is {}", tree_.slots[comparison.entry].name,
        entry.has_value() ? brief(to_text(entry.value())) : std::string("without a value")));
  }
  surprises_.push_back(std::move(surprise));
}

std::vector<Surprise> Judge::verdict(const RunEnd& end, const RunMeasures* measures) {
  judge_ending(end);
  judge_moments(end);
  if (measures != nullptr) judge_limits(*measures);
  return std::move(surprises_);
}

// A moment behind the end never comes: the scenario is about something else.
void Judge::judge_moments(const RunEnd& end) {
  const Scenario& scenario = *bound_.scenario;
  const auto missed = [&](Place place, const std::string& moment) {
    surprises_.push_back(
        {place,
         fmt::format("{} does not come: the run ends after {}", moment, counted(end.ticks, "tick")),
         why(end)});
  };
  const auto look = [&](Place place, std::optional<double> time,
                        std::optional<std::uint64_t> tick) {
    if (time && *time > to_seconds(end.last)) {
      missed(place, fmt::format("the time {:g} s", *time));
    } else if (!time && tick && *tick >= end.ticks) {
      missed(place, fmt::format("tick {}", *tick));
    }
  };
  for (const SetEntry& it : std::span(scenario.changes).subspan(scenario.changes_of_file))
    look(it.key_place, it.time, it.tick);
  for (const AnswerEvent& it : std::span(scenario.answers).subspan(scenario.answers_of_file))
    look(it.value_place, it.time, it.tick);
  for (const LateTick& it : std::span(scenario.late).subspan(scenario.late_of_file)) {
    if (it.tick >= end.ticks) missed(it.place, fmt::format("tick {}", it.tick));
  }
}

void Judge::judge_ending(const RunEnd& end) {
  const Scenario& scenario = *bound_.scenario;
  bool is_result_said = false;
  for (const Expectation& it : scenario.expectations) {
    if (it.kind != Kind::Ending) continue;
    is_result_said |= !it.results.empty();
    judge_ending(it, end);
  }
  if (is_result_said) return;
  if (end.reason == StopReason::Fault) {
    surprises_.push_back({scenario.place, "a leaf failed as a program", why(end)});
  } else if (end.reason == StopReason::MaxTicks && !scenario.max_ticks) {
    surprises_.push_back({scenario.place,
                          fmt::format("does not end within {} ticks", kMostScenarioTicks),
                          why(end)});
  }
}

void Judge::judge_ending(const Expectation& expected, const RunEnd& end) {
  if (!expected.results.empty() && !expected.expects(result_text(end))) {
    surprises_.push_back(
        {expected.result_place,
         fmt::format("expected {}, came {}", joined(expected.results, " or "), result_text(end)),
         why(end)});
  }
  const auto ticks = static_cast<double>(end.ticks);
  if (expected.ticks && !is_within(ticks, *expected.ticks)) {
    surprises_.push_back(
        {expected.ticks_place,
         fmt::format("expected {} ticks, came {}", range_text(*expected.ticks), end.ticks),
         why(end)});
  }
  if (expected.time && !is_within(to_seconds(end.time), *expected.time)) {
    surprises_.push_back({expected.time_place,
                          fmt::format("expected {} s, came {:g} s", range_text(*expected.time),
                                      to_seconds(end.time)),
                          why(end)});
  }
  if (!expected.node.empty()) judge_node(expected, end);
}

void Judge::judge_node(const Expectation& expected, const RunEnd& end) {
  const auto path = end.fault ? tree_.path(end.fault->node) : std::string();
  if (path == expected.node || path.ends_with('/' + expected.node)) return;
  surprises_.push_back({expected.place,
                        fmt::format("expected a fault of {}, came {}", expected.node,
                                    path.empty() ? "none" : "one of " + path),
                        why(end)});
}

std::vector<std::string> Judge::why(const RunEnd& end) const {
  if (end.fault) {
    return {fmt::format("{}: {} {}", in_last_tick(end), tree_.path(end.fault->node),
                        end.fault->message)};
  }
  if (!decided_.empty()) {
    return {fmt::format("{}: decided by {}", in_last_tick(end), decided_.back())};
  }
  if (running_.empty()) return {in_last_tick(end)};
  return {fmt::format("{}: still running: {}", in_last_tick(end), joined(running_, ", "))};
}

void Judge::judge_limits(const RunMeasures& measures) {
  for (const PreparedLimit& limit : bound_.limits) {
    const std::string name = to_text(limit.measure);
    for (std::size_t column = 0; column < measures.columns().size(); ++column) {
      const StudyColumn& it = measures.columns()[column];
      if (it.is_gap || it.measure != name) continue;
      const double value = measures.values()[column];
      const bool holds = are_nearly(value, limit.relation, limit.limit, kProgressEpsilon);
      if (!std::isnan(value) && holds) continue;
      surprises_.push_back({limit.of->place,
                            fmt::format("expected {}, came {}", limit.text,
                                        std::isnan(value) ? "no value: it was not reached"
                                                          : fmt::format("{:g}", value)),
                            {it.node}});
    }
  }
}

}  // namespace lockstep::host
