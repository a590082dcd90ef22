#include "record/live/event_counts.h"

#include <utility>

#include "record/json_lines.h"

namespace lockstep::host {
namespace {

template <class Item>
Item& at(std::vector<Item>& items, std::size_t index) {
  if (index >= items.size()) items.resize(index + 1);
  return items[index];
}

std::string text_at(const PacketRing& ring, std::uint64_t position, std::uint64_t count) {
  std::string text(ring.bytes(position, count));
  return text += ring.bytes(position + text.size(), count - text.size());
}

Activity activity_in(std::uint8_t state) {
  return NodeChange{.state = state}.activity();
}

Status status_in(std::uint8_t state) {
  return status_of(activity_in(state));
}

}  // namespace

// A node that a tick reaches, and that does not run after it, has completed in this tick.
EventCounts::Counts EventCounts::Node::until(std::uint64_t tick) const {
  Counts all = counts;
  if (!NodeChange{.state = state}.ticked()) return all;
  const Status status = status_in(state);
  if (status == Status::Success) all[kSuccess] += tick - since;
  if (status == Status::Failure) all[kFailure] += tick - since;
  if (status == Status::Skipped) all[kSkipped] += tick - since;
  return all;
}

static_assert(EventCounts::kFault == std::size_t{NodeTotals::kKinds});

EventCounts::EventCounts() {
  json_lines::set_tick_end(empty_end_, {});
}

void EventCounts::take(const PacketRing& ring, std::uint64_t from, std::uint64_t to,
                       std::vector<std::string>& counted) {
  ring.each_packet(from, to, [&](std::uint64_t position, const PacketHead& head) {
    if (head.is_tick != 0 && take_tick(ring, position, head)) {
      counted.push_back(counts_json(*this, head.tick));
    }
  });
}

// True if it has the whole state: what it does not name is idle. While the run stands, the last
// tick comes again for each listener that wants the whole state; what happened in it comes once.
bool EventCounts::take_tick(const PacketRing& ring, std::uint64_t position,
                            const PacketHead& head) {
  ++packet_;
  const bool is_again = std::exchange(last_, head.tick) == head.tick;
  bool is_full = false;
  moments_.clear();
  if (head.text != empty_end_.size()) {
    moment_changes_.clear();
    more_.clear();
    std::string end = text_at(ring, position + head.nodes * sizeof(NodeChange), head.text);
    is_full = end.ends_with(json_lines::kFullEnd);
    reader_.read(std::move(end), *this);
  }
  const bool has_moments = !moments_.empty() && !is_again;
  if (has_moments) settle(head.tick);
  ring.each_node(position, head.nodes,
                 [&](const NodeChange& change) { take_node(change, head.tick); });
  if (is_full) {
    for (NodeIndex node = 0; node < nodes_.size(); ++node) {
      if (nodes_[node].named != packet_) take_node({.node = node}, head.tick);
    }
  }
  if (has_moments) take_moments(head.tick);
  return is_full;
}

// The counts before a tick of several moments.
void EventCounts::settle(std::uint64_t tick) {
  before_.clear();
  for (Node& it : nodes_) {
    it.counts = it.until(tick);
    it.since = tick;
    it.settled = it.counts;
    before_.push_back({it.state});
  }
}

// Its nodes have been taken as if it had one moment.
void EventCounts::take_moments(std::uint64_t tick) {
  before_.resize(nodes_.size());
  first_moment_.clear();
  for (Node& it : nodes_) {
    it.counts = it.settled;
    it.since = tick + 1;
    first_moment_.push_back({it.state});
  }
  for (std::size_t i = moment_changes_.size(); i-- > 0;) {
    MomentChange& it = moment_changes_[i];
    it.after = std::exchange(at(first_moment_, it.node), it.before);
  }
  const auto add = [this](const NodeTotals& totals) {
    Counts& counts = at(nodes_, totals.node).counts;
    for (std::size_t kind = 0; kind < NodeTotals::kKinds; ++kind) {
      counts[kind] += totals.counts[kind];
    }
  };
  const MomentsView view{first_moment_, moments_, moment_changes_, more_};
  view.each(moment_, [&](std::span<const NodeState> now, const TickMoment& moment, bool) {
    for (NodeIndex node = 0; node < now.size() && node < before_.size(); ++node) {
      NodeTotals totals{.node = node};
      totals.add(before_[node], now[node], moment.times);
      if (!totals.empty()) add(totals);
    }
    before_.assign(now.begin(), now.end());
  });
  for (const NodeTotals& it : more_) add(it);
}

// A line with the whole state names nodes that are as they were.
void EventCounts::take_node(const NodeChange& change, std::uint64_t tick) {
  Node& node = at(nodes_, change.node);
  node.named = packet_;
  if (node.state == change.state) return;
  node.counts = node.until(tick);
  const bool was_running = status_in(node.state) == Status::Running;
  if (was_running && status_in(change.state) == Status::Idle) ++node.counts[kHalted];
  const bool was_held = activity_in(node.state) == Activity::Paused;
  if (!was_held && activity_in(change.state) == Activity::Paused) ++node.counts[kHeld];
  node.since = tick;
  node.state = change.state;
}

void EventCounts::take_fault(NodeIndex node) {
  ++at(nodes_, node).counts[kFault];
}

// A line with the whole state has values that are known.
void EventCounts::take_entry(std::size_t entry, std::optional<std::string_view> value) {
  Entry& known = at(entries_, entry);
  if (known.values > 0 && known.value == value) return;
  ++known.values;
  known.value = value;
}

}  // namespace lockstep::host
