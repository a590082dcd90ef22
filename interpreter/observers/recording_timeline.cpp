#include "observers/recording_timeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace lockstep {

void take(const RecordedTick& tick, std::uint64_t lost, Moment& moment) {
  moment.tick = tick.tick;
  moment.time = tick.time;
  moment.nodes.assign(tick.nodes.begin(), tick.nodes.end());
  moment.faults = tick.faults;
  moment.lost = lost;
}

RecordingTimeline::RecordingTimeline(RecordingReader& reader, const TimelineOptions& options)
    : reader_(reader), options_(options) {
  std::uint64_t expected = 0;
  while (const auto tick = reader_.next()) {
    keep(size_++, tick->tick - expected);
    last_tick_ = tick->tick;
    last_time_ = tick->time;
    expected = tick->tick + 1;
  }
  outcome_ = reader_.outcome();
  if (size_ > 0) go_to_begin();
}

// A keyframe of the tick that was just read, when it is time for one.
void RecordingTimeline::keep(std::uint64_t number, std::uint64_t lost) {
  if (!keyframes_.empty() &&
      reader_.bytes_read() - keyframes_.back().place.bytes < options_.distance) {
    return;
  }
  keyframes_.push_back({number, lost, reader_.place()});
  const std::uint64_t size =
      sizeof(Keyframe) + reader_.header().nodes.size() * sizeof(RecordedState);
  while (keyframes_.size() > 2 && keyframes_.size() * size > options_.most_memory) thin_out();
}

void RecordingTimeline::thin_out() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keyframes_.size(); i += 2) {
    if (i != kept) keyframes_[kept] = std::move(keyframes_[i]);
    ++kept;
  }
  keyframes_.resize(kept);
  options_.distance *= 2;
}

void RecordingTimeline::restore(const Keyframe& keyframe) {
  RecordedTick tick = keyframe.place.tick;
  tick.nodes = keyframe.place.states;
  take(tick, keyframe.lost, now_);
  now_.number = keyframe.number;
  failed_ = !reader_.go_to(keyframe.place);
  read_next();
}

void RecordingTimeline::read_next() {
  if (!failed_) next_ = reader_.next();
  if (!next_ && !at_end()) failed_ = true;
}

void RecordingTimeline::step_forward() {
  if (at_end() || failed_) return;
  take(*next_, next_->tick - now_.tick - 1, now_);
  ++now_.number;
  read_next();
}

void RecordingTimeline::step_back() {
  if (now_.number > 0) go_to_number(now_.number - 1);
}

void RecordingTimeline::go_to_number(std::uint64_t number) {
  const auto after = std::ranges::upper_bound(keyframes_, number, {}, &Keyframe::number);
  restore(*std::prev(after));
  while (now_.number < number && !failed_) step_forward();
}

void RecordingTimeline::go_to_tick(std::uint64_t tick) {
  const auto tick_of = [](const Keyframe& keyframe) { return keyframe.place.tick.tick; };
  const auto after = std::ranges::upper_bound(keyframes_, tick, {}, tick_of);
  restore(after == keyframes_.begin() ? *after : *std::prev(after));
  while (!at_end() && !failed_ && next_->tick <= tick) step_forward();
}

}  // namespace lockstep
