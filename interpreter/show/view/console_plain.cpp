#include "show/view/console_plain.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/core/synchronization.h"
#include "judge/summary/statistics.h"
#include "judge/summary/summary.h"
#include "show/view/waiting.h"
#include "trace/progress_text.h"

namespace lockstep::host {

ConsolePlain::ConsolePlain(Shape shape, Outlet& out, RealTime real_time)
    : shape_(std::move(shape)), out_(out), real_time_(real_time) {
  for (NodeIndex node = 0; node < shape_.nodes.size(); ++node) {
    if (shape_.nodes[node].held().empty()) leaves_.push_back({.node = node});
  }
  for (const NodeIndex node : synchronized_nodes(shape_)) {
    const ShapeNode& it = shape_.nodes[node];
    const std::size_t children = it.held().size();
    const bool is_pool = it.synchronization == Synchronization::Resources;
    nodes_.push_back({SynchronizedTicks(shape_, node), std::vector<Wait>(children),
                      std::vector<double>(is_pool ? children : 0)});
  }
}

void ConsolePlain::continue_with(std::uint64_t tick, Nanoseconds time) {
  tick_ = tick;
  time_ = time;
}

// What runs already was not started now: the run continues after a cut.
void ConsolePlain::run_started(const Moment& moment, const RunStart& start) {
  for (Leaf& leaf : leaves_) leaf.last = moment.status(leaf.node);
  print(fmt::format("run of {} {}, {:.6g} Hz{}", shape_.id,
                    start.first_tick == 0 ? "starts" : "continues", 1.0 / to_seconds(start.period),
                    start.real_time ? "" : ", virtual clock"));
}

void ConsolePlain::before_tick(const Moment&, std::uint64_t tick, Nanoseconds time) {
  tick_ = tick;
  time_ = time;
}

void ConsolePlain::after_tick(const Moment& moment, const TickReport& report) {
  for (const Fault& fault : report.faults) tell_fault(fault);
  has_ticked_ = true;
  if (moment.within.empty()) {
    tell_waits(moment);
    return tell_leaves(moment);
  }
  // A leaf may complete and be begun again, or be halted with what is around it, in one tick. And
  // it may begin and then be held.
  tell_waits(moment, Waits::Ends);
  moment.within.each_part(within_, [&](std::span<const NodeState> states, bool, bool) {
    for (Leaf& it : leaves_)
      tell_leaf(moment, it, states[it.node].status(), states[it.node].ticked());
  });
  tell_waits(moment, Waits::Begins);
}

void ConsolePlain::tell_waits(const Moment& moment, Waits which) {
  for (Watched& node : nodes_) tell_waits(moment, node, which);
}

void ConsolePlain::tell_leaves(const Moment& moment) {
  for (Leaf& leaf : leaves_) {
    tell_leaf(moment, leaf, moment.status(leaf.node), moment.ticked(leaf.node));
  }
}

void ConsolePlain::run_ended(const Moment& moment, const RunEnd& end) {
  for (const Fault& fault : moment.live->tolerated()) tell_fault(fault);
  if (has_ticked_) {  // what was halted
    tell_waits(moment);
    tell_leaves(moment);
  }
  tell_left_out();
  if (short_waits_ > 0) print(fmt::format("... {} left out", counted(short_waits_, "short wait")));
  // The message of the command says which fault it is.
  print(fmt::format("run ends: {} after {}", ending(to_string(end.result()), to_string(end.reason)),
                    counted(end.ticks, "tick")));
}

void ConsolePlain::print(std::string_view text) {
  out_.say(fmt::format("{:10.3f} s  tick {:<6}  {}\n", to_seconds(time_), tick_.load(),
                       printable(text)));
}

bool ConsolePlain::may_print() {
  if (!budget_.take(real_time_())) return false;
  tell_left_out();
  return true;
}

void ConsolePlain::tell_left_out() {
  const std::uint64_t left_out = budget_.take_left_out() + fault_budget_.take_left_out();
  if (left_out > 0) print(fmt::format("... {} lines left out", left_out));
}

void ConsolePlain::tell_fault(const Fault& fault) {
  if (!fault_budget_.take(real_time_())) return;
  print(fault.in_last_halt ? fault_text(shape_, fault)
                           : fmt::format("{}: failed: {}; counted as Failure",
                                         shape_.nodes[fault.node].path, fault.message));
}

void ConsolePlain::tell_leaf(const Moment& moment, Leaf& leaf, Status now, bool ticked) {
  const Status before = std::exchange(leaf.last, now);
  if (now != before) {
    tell_again(leaf, before);
    if (now == Status::Running) {
      tell(leaf.node, "started");
    } else if (now != Status::Idle) {
      tell_result(moment, leaf, now);
    } else if (before == Status::Running) {
      tell(leaf.node, "halted");
    }
  } else if (ticked && now == Status::Failure && fails_otherwise(moment, leaf)) {
    tell_again(leaf, now);
    tell_result(moment, leaf, now);
  } else if (ticked && is_complete(now)) {
    if (leaf.again++ == 0) leaf.first = tick_;
    leaf.latest = tick_;
    leaf.latest_time = time_;
  } else if (leaf.again > 0 && time_.load() - leaf.latest_time >= kShortWait) {
    tell_again(leaf, now);
  }
}

// "not heard for 0.2 s" is no other reason than the one before, with 0.1 s.
std::string_view ConsolePlain::kind_of_reason(std::string_view reason) {
  return reason.substr(0, reason.find_first_of("0123456789"));
}

bool ConsolePlain::fails_otherwise(const Moment& moment, const Leaf& leaf) {
  return kind_of_reason(moment.reason(leaf.node)) != leaf.reason;
}

void ConsolePlain::tell_result(const Moment& moment, Leaf& leaf, Status status) {
  const std::string_view reason = moment.reason(leaf.node);
  leaf.reason = kind_of_reason(reason);
  const bool has_one = status == Status::Failure && !reason.empty();
  tell(leaf.node,
       has_one ? fmt::format("{}: {}", to_string(status), reason) : std::string(to_string(status)));
}

void ConsolePlain::tell_again(Leaf& leaf, Status status) {
  const std::uint64_t again = std::exchange(leaf.again, 0);
  if (again == 0) return;
  tell(leaf.node, again == 1 ? fmt::format("{} again in tick {}", to_string(status), leaf.first)
                             : fmt::format("{} {} more times, in ticks {} to {}", to_string(status),
                                           again, leaf.first, leaf.latest));
}

void ConsolePlain::tell_waits(const Moment& moment, Watched& node, Waits which) {
  const SynchronizedTick tick = node.ticks.read(moment);
  for (std::size_t i = 0; i < node.limits.size(); ++i) {
    node.limits[i] = moment.limit(node.ticks.children()[i] - 1);
  }
  if (!tick.ticked) {  // it is held itself, or it was halted
    if (tick.status != Status::Running) std::ranges::fill(node.waits, Wait{});
    return;
  }
  for (std::size_t child = 0; child < node.waits.size(); ++child) {
    if (tick.held[child] && tick.status == Status::Running) {
      if (which != Waits::Ends) tell_wait(moment, node, child, tick);
    } else if (node.waits[child].held && which != Waits::Begins) {
      tell_end_of_wait(moment, node, child);
    }
  }
}

void ConsolePlain::tell_wait(const Moment& moment, Watched& node, std::size_t child,
                             const SynchronizedTick& tick) {
  Wait& wait = node.waits[child];
  if (!wait.held) {
    wait.held = true;
    wait.since = tick.time;
  }
  const std::string_view why = kind_of_reason(reason_of(moment, node, child));
  if (wait.told && wait.why != why) wait.told = false;
  const bool is_soon = wait.last_end && wait.since - *wait.last_end <= kShortWait;
  if (wait.told || (is_soon && tick.time - wait.since < kShortWait)) return;
  wait.told = true;
  wait.why = why;
  std::string text = waiting(moment, node, child, tick);
  if (wait.since != tick.time) text += fmt::format(", since {:.3f} s", to_seconds(wait.since));
  tell(node.ticks.children()[child], text);
}

// "heard at 0.24, 0.02 s ago"; "" of a robot that was never heard.
std::string ConsolePlain::last_word(const Moment& moment, NodeIndex robot, double progress) {
  const auto it = std::ranges::find(moment.heard, robot, &Heard::node);
  if (it == moment.heard.end() || it->word == 0) return "";
  return heard_text(progress, moment.time - it->time);
}

// Of a member of a pool: why other robots do not give it what it waits for.
std::string_view ConsolePlain::reason_of(const Moment& moment, const Watched& node,
                                         std::size_t child) const {
  if (shape_.nodes[node.ticks.node()].synchronization != Synchronization::Resources) return "";
  const auto asker = asker_of(shape_, node.ticks.children()[child] - 1);
  return asker ? moment.reason(*asker) : std::string_view();
}

std::string ConsolePlain::waiting(const Moment& moment, const Watched& node, std::size_t child,
                                  const SynchronizedTick& tick) const {
  const ShapeNode& self = shape_.nodes[node.ticks.node()];
  const std::vector<std::string> names = child_names(shape_, node.ticks.node());
  const auto name_of = [&](std::size_t number) { return names[number]; };
  if (self.synchronization == Synchronization::Resources) {
    return ownership_text(
        {.resources = self.resources,
         .members = node.limits.size(),
         .limit = [&](std::size_t number) { return node.limits[number]; },
         .name_of = name_of,
         .why = [&](std::size_t) { return std::string(reason_of(moment, node, child)); }},
        child);
  }
  const auto robot = [&](std::size_t number) -> std::optional<NodeIndex> {
    const NodeIndex it = node.ticks.children()[number];
    return is_robot(shape_, it) ? std::optional(it) : std::nullopt;
  };
  const auto heard = [&](std::size_t number) {
    const auto it = robot(number);
    return it ? last_word(moment, *it, tick.used[number]) : std::string();
  };
  const auto lost = [&](std::size_t number) {
    const auto it = robot(number);
    if (!it || moment.status(*it) != Status::Failure) return std::string();
    const std::string last = heard(number);
    return std::string(moment.reason(*it)) + (last.empty() ? "" : " (" + last + ")");
  };
  const WaitedAt waited{.synchronization = self.synchronization,
                        .limit = tick.limit,
                        .progress = tick.used,
                        .name_of = name_of,
                        .group = self.is_group() ? self.segment : "",
                        .lost = lost,
                        .heard = heard};
  const auto status = [&](NodeIndex it) { return moment.status(it); };
  const auto member = [&](std::size_t number) { return node.ticks.children()[number] - 1; };
  if (self.is_group() && waits_to_begin(status(member(child)), status(member(child) + 1))) {
    return beginning_text(
        waited, [&](std::size_t number) { return status(member(number)) == Status::Running; });
  }
  return waiting_text(waited, child);
}

void ConsolePlain::tell_end_of_wait(const Moment& moment, Watched& node, std::size_t child) {
  const NodeIndex it = node.ticks.children()[child];
  const Nanoseconds now = time_;
  const Wait wait = std::exchange(node.waits[child], Wait{.last_end = now});
  if (!wait.told) {
    ++short_waits_;
  } else if (moment.ticked(it)) {
    tell(it, fmt::format("continues after {:.3f} s", to_seconds(now - wait.since)));
  }
}

void ConsolePlain::tell(NodeIndex node, std::string_view what) {
  if (may_print()) print(fmt::format("{}: {}", shape_.nodes[node].path, what));
}

}  // namespace lockstep::host
