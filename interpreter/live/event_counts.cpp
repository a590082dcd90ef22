#include "live/event_counts.h"

#include <fmt/format.h>

#include <utility>

namespace lockstep {
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

void EventCounts::take(const PacketRing& ring, std::uint64_t from, std::uint64_t to,
                       std::vector<std::string>& counted) {
  while (from < to) {
    const PacketHead head = ring.head(from);
    if (head.is_tick != 0 && take_tick(ring, from + sizeof head, head)) {
      counted.push_back(text(head.tick));
    }
    from += PacketRing::in_cells(packet_size(head));
  }
}

// True if it has the whole state: what it does not name is idle.
bool EventCounts::take_tick(const PacketRing& ring, std::uint64_t position,
                            const PacketHead& head) {
  constexpr std::string_view kEmpty = "]}\n", kFull = ",\"full\":true}\n";
  ++tick_;
  for (std::uint64_t left = head.nodes; left > 0;) {
    const auto nodes = ring.nodes(position, left);
    for (const NodeChange& change : nodes) take_node(change, head.tick);
    position += nodes.size_bytes();
    left -= nodes.size();
  }
  if (head.text == kEmpty.size()) return false;
  const std::string end = text_at(ring, position, head.text);
  take_text(end);
  if (!end.ends_with(kFull)) return false;
  for (NodeIndex node = 0; node < nodes_.size(); ++node) {
    if (nodes_[node].named != tick_) take_node({.node = node}, head.tick);
  }
  return true;
}

// A line with the whole state names nodes that are as they were.
void EventCounts::take_node(const NodeChange& change, std::uint64_t tick) {
  Node& node = at(nodes_, change.node);
  node.named = tick_;
  if (node.state == change.state) return;
  node.counts = node.until(tick);
  const bool was_running = status_in(node.state) == Status::Running;
  if (was_running && status_in(change.state) == Status::Idle) ++node.counts[kHalted];
  const bool was_held = activity_in(node.state) == Activity::Paused;
  if (!was_held && activity_in(change.state) == Activity::Paused) ++node.counts[kHeld];
  node.since = tick;
  node.state = change.state;
}

// The end of a line: ],"faults":[[3,"threw"]],"entries":[[0,"1"]]}
void EventCounts::take_text(std::string text) {
  text.insert(0, "{\"nodes\":[");
  reader_.read(text, [this](JsonObject line) {
    const auto faults = [this](JsonValue all) {
      all.each_item([this](JsonValue it) { take_fault(it); });
    };
    const auto entries = [this](JsonValue all) {
      all.each_item([this](JsonValue it) { take_entry(it); });
    };
    line.read({{"faults", faults, kMayLack}, {"entries", entries, kMayLack}});
  });
}

void EventCounts::take_fault(JsonValue fault) {
  bool is_node = true;
  fault.each_item([&](JsonValue it) {
    if (std::exchange(is_node, false)) {
      ++at(nodes_, it.whole()).counts[kFault];
    } else {
      it.skip();
    }
  });
}

// A line with the whole state has values that are known.
void EventCounts::take_entry(JsonValue entry) {
  Entry* known = nullptr;
  entry.each_item([&](JsonValue it) {
    if (known == nullptr) {
      known = &at(entries_, it.whole());
      return;
    }
    const bool is_long = it.is_null();
    const std::string_view value = is_long ? std::string_view() : it.text();
    if (known->values > 0 && known->is_long == is_long && known->value == value) return;
    ++known->values;
    known->is_long = is_long;
    known->value = value;
  });
}

// "counts":[[3,1,150,0,0,2,0],…],"written":[[0,12],…]
std::string EventCounts::text(std::uint64_t tick) const {
  std::string all = ",\"counts\":[";
  const char* separator = "";
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Counts it = nodes_[i].until(tick + 1);
    if (it == Counts{}) continue;
    all += fmt::format("{}[{},{},{},{},{},{},{}]", separator, i, it[kSuccess], it[kFailure],
                       it[kSkipped], it[kHalted], it[kHeld], it[kFault]);
    separator = ",";
  }
  all += "],\"written\":[";
  separator = "";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].values == 0) continue;
    all += fmt::format("{}[{},{}]", separator, i, entries_[i].values);
    separator = ",";
  }
  return all += ']';
}

}  // namespace lockstep
