#include "record/read/recording_timeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "record/read/tick_results.h"

namespace lockstep::host {
namespace {

std::size_t memory_of(const std::vector<LeafLine>& lines) {
  std::size_t size = 0;
  for (const LeafLine& it : lines) size += sizeof it + it.who.size() + it.text.size();
  return size;
}

}  // namespace

// A recording that is read from its middle begins with values of which the ticks are not known.
void Past::add(const RecordedTick& tick) {
  // After a cut, the line has the whole state, too, but the entries are those that have changed.
  const bool is_whole = tick.whole && tick.entries.data() == tick.whole->data();
  const bool begins_later = entries.empty() && is_whole;
  for (const RecordedEntry& it : tick.entries) {
    if (it.entry >= entries.size()) entries.resize(it.entry + 1);
    EntryState& entry = entries[it.entry];
    const bool is_same = entry.is_long == !it.value && entry.text == it.value.value_or("");
    if (is_whole && entry.changed && is_same) continue;  // a whole state repeats what is known
    entry.set(it.value ? &*it.value : nullptr, tick.tick);
    entry.is_older = begins_later;
  }
  for (const LeafLine& line : tick.logs) logs.add(line);
  take_heard(tick.heard, from_seconds(tick.time), heard);
}

std::size_t Past::memory() const {
  std::size_t size = memory_of(logs.lines) + heard.size() * sizeof(Heard);
  for (const EntryState& it : entries) size += sizeof it + it.text.size();
  return size;
}

void take(const RecordedTick& tick, std::uint64_t lost, TimelineTick& moment) {
  moment.tick = tick.tick;
  moment.time = tick.time;
  moment.nodes.assign(tick.nodes.begin(), tick.nodes.end());
  moment.faults.assign(tick.faults.begin(), tick.faults.end());
  moment.results = results_within(tick);
  moment.entries.assign(tick.entries.begin(), tick.entries.end());
  moment.logs.assign(tick.logs.begin(), tick.logs.end());
  moment.lost = lost;
  moment.past.add(tick);
}

RecordingTimeline::RecordingTimeline(RecordingReader& reader, const TimelineOptions& options)
    : reader_(reader), options_(options) {
  const auto [from, to] = options_.range;
  if (from > 0) reader_.skip_to(from);
  std::uint64_t expected = std::max(from, reader_.header().first_tick);
  Past past;
  auto tick = reader_.next();
  for (; tick && tick->tick <= to; tick = reader_.next()) {
    if (tick->tick >= from) {
      keep(*tick, tick->tick - expected, past);
      ++size_;
      last_tick_ = tick->tick;
      last_time_ = tick->time;
      expected = tick->tick + 1;
    }
    past.add(*tick);
  }
  outcome_ = reader_.outcome();
  if (size_ > 0) go_to_begin();
}

std::size_t RecordingTimeline::Keyframe::memory() const {
  std::size_t size = sizeof(Keyframe) + moment.nodes.size() * sizeof(RecordedState);
  for (const RecordedFault& fault : moment.faults) size += sizeof fault + fault.message.size();
  for (const RecordedEntry& it : moment.entries) size += sizeof it + it.value.value_or("").size();
  for (const std::string& it : moment.results) size += sizeof it + it.capacity();
  return size + memory_of(moment.logs) + moment.past.memory();
}

// A keyframe of the tick that was just read, when it is time for one.
void RecordingTimeline::keep(const RecordedTick& tick, std::uint64_t lost, const Past& before) {
  const RecordingReader::Position position = reader_.position();
  const auto distance = [&] {
    return position.lines.bytes - keyframes_.back().position.lines.bytes;
  };
  if (!keyframes_.empty() && distance() < options_.distance) return;
  Keyframe& keyframe = keyframes_.emplace_back();
  keyframe.position = position;
  keyframe.moment.number = size_;
  keyframe.moment.past = before;
  take(tick, lost, keyframe.moment);
  memory_ += keyframe.memory();
  while (keyframes_.size() > 2 && memory_ > options_.most_memory) thin_out();
}

void RecordingTimeline::thin_out() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    if (i % 2 != 0) {
      memory_ -= keyframes_[i].memory();
    } else if (i != kept++) {
      keyframes_[kept - 1] = std::move(keyframes_[i]);
    }
  }
  keyframes_.resize(kept);
  options_.distance *= 2;
}

void RecordingTimeline::restore(const Keyframe& keyframe) {
  now_ = keyframe.moment;
  failed_ = !reader_.go_to(keyframe.position, now_.nodes);
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
  const auto number_of = [](const Keyframe& keyframe) { return keyframe.moment.number; };
  const auto after = std::ranges::upper_bound(keyframes_, number, {}, number_of);
  restore(*std::prev(after));
  while (now_.number < number && !failed_) step_forward();
}

void RecordingTimeline::go_to_tick(std::uint64_t tick) {
  const auto tick_of = [](const Keyframe& keyframe) { return keyframe.moment.tick; };
  const auto after = std::ranges::upper_bound(keyframes_, tick, {}, tick_of);
  restore(after == keyframes_.begin() ? *after : *std::prev(after));
  while (!at_end() && !failed_ && next_->tick <= tick) step_forward();
}

}  // namespace lockstep::host
