#include "observers/console_plain.h"

#include <fmt/format.h>

#include "core/diagnostics.h"
#include "observers/statistics.h"
#include "observers/summary.h"
#include "observers/waiting.h"

namespace lockstep {

ConsolePlain::ConsolePlain(const Tree& tree, Outlet& out, RealTime real_time)
    : tree_(tree), out_(out), real_time_(real_time) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (tree.nodes[node].children == 0) leaves_.push_back(node);
  }
  last_.resize(leaves_.size());
  for (const NodeIndex node : synchronized_nodes(tree)) {
    const std::size_t children = tree.nodes[node].children;
    nodes_.push_back({SynchronizedProbe(tree, node), std::vector<Watched::Child>(children)});
  }
}

void ConsolePlain::run_started(Ticker&, const RunStart& start) {
  print(fmt::format("run of {} starts, {:.6g} Hz{}", tree_.id, 1.0 / to_seconds(start.period),
                    start.real_time ? "" : ", virtual clock"));
}

void ConsolePlain::before_tick(Ticker&, std::uint64_t tick, Nanoseconds time) {
  tick_ = tick;
  time_ = time;
}

void ConsolePlain::after_tick(Ticker& ticker, const TickReport& report) {
  for (const Fault& fault : report.faults) tell_fault(fault);
  for (Watched& node : nodes_) tell_held(ticker, node);
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const Status now = ticker.status(leaves_[i]);
    if (now != last_[i]) tell_leaf(leaves_[i], last_[i], now);
    last_[i] = now;
  }
}

void ConsolePlain::run_ended(Ticker& ticker, const RunEnd& end) {
  TickReport halts;
  halts.faults = ticker.tolerated();
  after_tick(ticker, halts);
  tell_left_out();
  if (end.fault) print("fault: " + fault_text(tree_, *end.fault));
  print(fmt::format("run ends: {} ({}) after {}", to_string(end.result()), to_string(end.reason),
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
  const std::string path = tree_.path(fault.node);
  print(fault.in_last_halt
            ? fmt::format("{}: could not be halted: {}", path, fault.message)
            : fmt::format("{}: failed: {}; counted as Failure", path, fault.message));
}

void ConsolePlain::tell_leaf(NodeIndex leaf, Status before, Status now) {
  const bool halted = now == Status::Idle && before == Status::Running;
  // A completed leaf that becomes idle has been told already.
  if (now == Status::Idle && !halted) return;
  if (!may_print()) return;
  const std::string_view what = halted                   ? "halted"
                                : now == Status::Running ? "started"
                                                         : to_string(now);
  print(fmt::format("{}: {}", tree_.path(leaf), what));
}

void ConsolePlain::tell_held(Ticker& ticker, Watched& node) {
  const Nanoseconds now = time_;
  const SynchronizedTick tick = node.probe.read(ticker, now);
  if (!tick.ticked) return;
  for (std::size_t child = 0; child < node.waits.size(); ++child) {
    Watched::Child& wait = node.waits[child];
    if (tick.held[child] && tick.status == Status::Running) {
      if (!wait.held) wait = {true, false, now};
      if (wait.told || now - wait.since < kShortestWait) continue;
      wait.told = true;
      tell_wait(node, child, waiting_text(tree_, node.probe.node(), tick.progress, child));
    } else {
      const bool goes_on = wait.told && ticker.ticked(node.probe.children()[child]);
      if (goes_on) {
        tell_wait(node, child, fmt::format("goes on after {:.3f} s", to_seconds(now - wait.since)));
      }
      wait = {};
    }
  }
}

void ConsolePlain::tell_wait(const Watched& node, std::size_t child, std::string_view text) {
  if (!may_print()) return;
  print(fmt::format("{}: {}", tree_.path(node.probe.children()[child]), text));
}

}  // namespace lockstep
