#include "run/breakpoints.h"

#include <algorithm>
#include <utility>

#include "engine/synchronized.h"
#include "trace/completion.h"

namespace lockstep::host {

void Breakpoints::set(Ticker& ticker, Breakpoint breakpoint) {
  remove(breakpoint);
  Watched watched{.breakpoint = breakpoint, .before = ticker.node_state(breakpoint.node)};
  if (breakpoint.when == Breakpoint::When::Barrier) {
    for_each_child(ticker.tree(), breakpoint.node,
                   [&](NodeIndex child) { watched.were_held.push_back(ticker.held(child)); });
    watched.limit = limit(ticker, breakpoint.node);
  }
  watched_.push_back(std::move(watched));
}

void Breakpoints::remove(Breakpoint breakpoint) {
  std::erase_if(watched_, [&](const Watched& it) { return it.breakpoint == breakpoint; });
}

std::optional<Breakpoint> Breakpoints::reached(Ticker& ticker) {
  std::optional<Breakpoint> first;
  for (Watched& watched : watched_) {
    if (is_reached(ticker, watched) && !first) first = watched.breakpoint;
  }
  return first;
}

// Each call also notes what the next one compares with.
bool Breakpoints::is_reached(Ticker& ticker, Watched& watched) {
  const NodeIndex node = watched.breakpoint.node;
  if (watched.breakpoint.when == Breakpoint::When::Barrier) {
    return is_barrier_reached(ticker, watched) && ticker.status(node) == Status::Running;
  }
  const MomentsView moments = ticker.moments();
  if (moments.empty()) return is_reached(ticker.node_state(node), watched);
  bool is_any = false;
  moments.each_part(moment_, [&](std::span<const NodeState> states, bool, bool) {
    if (is_reached(states[node], watched)) is_any = true;
  });
  watched.before = ticker.node_state(node);  // of the whole tick
  return is_any;
}

bool Breakpoints::is_reached(NodeState state, Watched& watched) {
  const NodeState before = std::exchange(watched.before, state);
  const Status now = state.status();
  if (!state.ticked() || (has_ended(now) && !completes_newly(before, state))) return false;
  // When it completes, an ancestor that ends too makes it idle again.
  switch (watched.breakpoint.when) {
    case Breakpoint::When::Begins:
      return before.status() != Status::Running;
    case Breakpoint::When::Succeeds:
      return now == Status::Success;
    case Breakpoint::When::Fails:
      return now == Status::Failure;
    default:
      return now != Status::Running;
  }
}

bool Breakpoints::is_barrier_reached(Ticker& ticker, Watched& watched) {
  const NodeIndex node = watched.breakpoint.node;
  bool is_new = false;
  std::size_t number = 0;
  for_each_child(ticker.tree(), node, [&](NodeIndex child) {
    const bool is_held = ticker.held(child);
    is_new |= is_held && !watched.were_held[number];
    watched.were_held[number++] = is_held;
  });
  const double now = ticker.ticked(node) ? limit(ticker, node) : watched.limit;
  const double before = std::exchange(watched.limit, now);
  const bool moves_on =
      synchronization(ticker.node(node)) == Synchronization::Absolute && before > 0 && now > before;
  return is_new || moves_on;
}

}  // namespace lockstep::host
