#include "judge/measure/synchronized_ticks.h"

#include <algorithm>
#include <cstring>

#include "base/core/resource_set.h"
#include "base/core/synchronization.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMany = 8;  // children: of fewer, each is looked at by itself

// A pool compares nothing.
Guards guards_of(const Shape& shape, NodeIndex node) {
  std::vector<bool> guards;
  if (shape.nodes[node].synchronization == Synchronization::Resources) return Guards();
  for (const NodeIndex child : shape.nodes[node].held()) {
    guards.push_back(shape.nodes[child].is_guard);
  }
  return Guards(std::move(guards));
}

}  // namespace

Guards::Guards(std::vector<bool> guards) {
  for (std::size_t child = 0; child < guards.size(); ++child) {
    if (guards[child]) places_.push_back(child);
  }
  if (!places_.empty()) others_.resize(guards.size());
}

std::span<const double> Guards::leave_out(std::span<const double> progress) {
  if (places_.empty()) return progress;
  std::ranges::copy(progress, others_.begin());
  for (const std::size_t guard : places_) others_[guard] = kLeftOut;
  return others_;
}

SynchronizedTicks::SynchronizedTicks(const Shape& shape, NodeIndex node, bool with_flags)
    : node_(node),
      children_(shape.nodes[node].held()),
      is_group_(shape.nodes[node].is_group()),
      is_pool_(shape.nodes[node].synchronization == Synchronization::Resources),
      compares_(compares_progress(shape.nodes[node].synchronization)),
      are_leaves_(!is_group_ && children_.size() >= kMany &&
                  children_.back() - children_.front() + 1 == children_.size()),
      with_flags_(with_flags),
      held_(children_.size()),
      guards_(guards_of(shape, node)) {
  for (const NodeIndex child : shape.nodes[node].members) {
    members_.push_back(shape.nodes[child].parent.value_or(child));
  }
}

void SynchronizedTicks::read_held(const Moment& moment, bool asked) {
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const NodeIndex node = children_[child];
    if (is_pool_) {
      held_.set(child, moment.ticked(members_[child]) && waits(moment.limit(members_[child])));
      continue;
    }
    const bool asks = !is_group_ ? asked : moment.ticked(members_[child]);
    const bool is_held =
        moment.held(node) ||
        (is_group_ && waits_to_begin(moment.status(members_[child]), moment.status(node)));
    held_.set(child, moment.status(node), moment.ticked(node) || !asks, is_held && asks);
  }
}

// As most often. They are looked at eight at a time.
bool SynchronizedTicks::all_run(const Moment& moment) const {
  if (!are_leaves_ || is_pool_ || !moment.ended.empty()) return false;
  const auto all = moment.activity.subspan(children_.front(), children_.size());
  constexpr std::uint64_t kRun = 0x0101010101010101u * static_cast<std::uint8_t>(Activity::Running);
  std::size_t child = 0;
  for (std::uint64_t eight = 0; child + sizeof eight <= all.size(); child += sizeof eight) {
    std::memcpy(&eight, &all[child], sizeof eight);
    if (eight != kRun) return false;
  }
  return std::ranges::all_of(all.subspan(child),
                             [](Activity it) { return it == Activity::Running; });
}

void SynchronizedTicks::read_flags(const Moment& moment, bool asked) {
  if (all_run(moment)) return held_.set_all_run();
  held_.set_others();
  read_held(moment, asked);
  if (!asked) return;
  for (std::size_t child = 0; child < children_.size(); ++child) {
    held_.set_succeeded(child, moment.has_succeeded(children_[child]));
  }
}

void SynchronizedTicks::read(const Moment& moment, SynchronizedTick& tick) {
  const bool asked = asked_children(moment, node_, children_, is_group_);
  if (with_flags_) read_flags(moment, asked);
  if (!asked) {
    const Status status = moment.status(node_);
    const bool is_of_others = status == Status::Running && !is_group_ && !moment.held(node_);
    tick = {.time = moment.time, .status = status, .is_of_others = is_of_others};
    return;
  }
  tick.time = moment.time;
  tick.ticked = true;
  tick.is_of_others = false;
  tick.status = moment.status(node_);
  if (compares_) tick.limit = moment.limit(node_);
  tick.used = moment.used(node_);
  tick.progress = guards_.leave_out(tick.used);
  if (!with_flags_) return;
  tick.held = held_.held();
  tick.succeeded = held_.succeeded();
}

}  // namespace lockstep::host
