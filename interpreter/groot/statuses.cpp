#include "groot/statuses.h"

#include <algorithm>
#include <utility>

#include "groot/message.h"

namespace lockstep::host {
namespace {

// An idle node has what it was before: 10 and that status.
constexpr char kWas = 10;

}  // namespace

GrootStatuses::GrootStatuses(std::span<const NodeIndex> order) : places_(order.size()) {
  for (const NodeIndex node : order) {
    append_number(bytes_, groot_uid(node), 2);
    places_[node] = bytes_.size();
    bytes_ += static_cast<char>(Status::Idle);
  }
}

void GrootStatuses::change(NodeIndex node, Status status, Nanoseconds time) {
  if (node >= places_.size()) return;  // a group, which Groot2 has no place for
  char& shown = bytes_[places_[node]];
  const bool is_idle = shown == 0 || shown >= kWas;
  if (status != Status::Idle) {
    // Running, and paused or not: to Groot2, that is the same.
    if (std::exchange(shown, static_cast<char>(status)) == static_cast<char>(status)) return;
  } else if (!is_idle) {
    shown = static_cast<char>(shown + kWas);
  } else {
    return;
  }
  if (!is_recording_) return;
  const auto since = std::chrono::duration_cast<std::chrono::microseconds>(
      std::max(time - start_, Nanoseconds(0)));
  transitions_.push_back({static_cast<std::uint64_t>(since.count()), groot_uid(node), status});
  if (transitions_.size() > kMostTransitions) transitions_.pop_front();
}

void GrootStatuses::start_recording(Nanoseconds now) {
  transitions_.clear();
  start_ = now;
  is_recording_ = true;
}

std::string GrootStatuses::take_transitions() {
  std::string bytes;
  for (const Transition& it : std::exchange(transitions_, {})) {
    append_number(bytes, it.time, 6);
    append_number(bytes, it.uid, 2);
    bytes += static_cast<char>(it.status);
  }
  return bytes;
}

}  // namespace lockstep::host
