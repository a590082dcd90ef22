#include "live/status_feed.h"

#include <algorithm>

#include "core/differences.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// For three ticks that change everything, and for many that change little.
std::size_t room_for_statuses(const Tree& tree) {
  constexpr std::size_t kLeast = 256u << 10;
  return std::max<std::size_t>(kLeast, 3 * packet_size(tree.nodes.size(), 0));
}

}  // namespace

StatusFeed::StatusFeed(const Tree& tree)
    : passed_on_(tree.nodes.size()), changes_(tree.nodes.size()), ring_(room_for_statuses(tree)) {}

void StatusFeed::after_tick(Ticker& ticker, const TickReport& report) {
  const std::span<const Activity> now = ticker.run_state().activity;
  std::size_t count = 0;
  for_each_difference(now, passed_on_.data(), [&](NodeIndex node) {
    changes_[count++] = {.node = node, .state = static_cast<std::uint8_t>(now[node])};
  });
  if (count == 0) return;
  const std::span<const NodeChange> changes(changes_.data(), count);
  const PacketHead head{.tick = report.tick, .time = report.time.count()};
  if (!ring_.push({.head = head, .nodes = changes})) return;
  for (const NodeChange& it : changes) passed_on_[it.node] = it.state;
}

}  // namespace lockstep::host
