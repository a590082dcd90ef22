#include "record/live/status_feed.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// For three ticks that change everything, and for many that change little.
std::size_t room_for_statuses(const Shape& shape) {
  constexpr std::size_t kLeast = 256u << 10;
  return std::max<std::size_t>(kLeast, 3 * packet_size(shape.nodes.size(), 0));
}

}  // namespace

StatusFeed::StatusFeed(const Shape& shape)
    : passed_on_(shape.nodes.size()),
      moment_(shape.nodes.size()),
      changes_(shape.nodes.size()),
      ring_(room_for_statuses(shape)) {}

void StatusFeed::after_tick(const Moment& moment, const TickReport& report) {
  moment.within.each(moment_, [&](std::span<const NodeState> states, const TickMoment&, bool) {
    pass_on([&](NodeIndex node) { return states[node].activity(); }, report);
  });
  pass_on([&](NodeIndex node) { return moment.activity[node]; }, report);
}

template <class ActivityOf>
void StatusFeed::pass_on(ActivityOf activity_of, const TickReport& report) {
  std::size_t count = 0;
  for (NodeIndex node = 0; node < passed_on_.size(); ++node) {
    const Activity now = activity_of(node);
    if (now == passed_on_[node]) continue;
    changes_[count++] = {.node = node, .state = static_cast<std::uint8_t>(now)};
  }
  if (count == 0) return;
  const std::span<const NodeChange> changes(changes_.data(), count);
  const PacketHead head{.tick = report.tick, .time = report.time.count()};
  if (!ring_.push({.head = head, .nodes = changes})) return;
  for (const NodeChange& it : changes) passed_on_[it.node] = it.activity();
}

}  // namespace lockstep::host
