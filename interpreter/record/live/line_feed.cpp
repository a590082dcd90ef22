#include "record/live/line_feed.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "record/live/packet_printer.h"

namespace lockstep::host {
namespace {

// Room for some lines that have all nodes, and for seconds of a smaller tree at 1 kHz.
std::size_t room_for(const Shape& shape) {
  constexpr std::size_t kLines = 3, kLeast = 2u << 20;
  return std::max(kLeast, kLines * packet_size(shape.nodes.size(), kLeast / 8));
}

}  // namespace

LineFeed::LineFeed(const Shape& shape, RunDescription run, RealTime real_time)
    : real_time_(real_time),
      deadlines_(run.rate_hz),
      packets_(shape, std::move(run)),
      ring_(room_for(shape)),
      room_(64u << 10) {}

void LineFeed::log(std::string_view who, std::string_view level, std::string_view text) {
  packets_.log(who, level, text);
}

void LineFeed::run_started(const Moment&, const RunStart& start) {
  is_real_time_ = start.real_time;
  header_ = packets_.header(start);
  if (start.first_tick > 0) packets_.add_whole();
}

// Only a tick whose line is due asks leaves for their progress.
void LineFeed::before_tick(const Moment& moment, std::uint64_t, Nanoseconds time) {
  began_ = real_time_();
  if (is_real_time_) publish_before_late(time);
  is_due_ = began_ - published_ >= kPeriod;
  if (!is_due_) return;
  published_ = began_;
  packets_.before_tick(moment);
}

// Only the time of the tick before shows that a tick began late, so both have lines. Everything
// else of that tick is known already.
void LineFeed::publish_before_late(Nanoseconds time) {
  if (!has_ticked_ || 2 * (time - last_.time) < 3 * deadlines_.at(1)) return;
  std::string text;
  json_lines::set_tick_end(text, {});
  Packet packet{.text = text};
  packet.head.is_tick = 1;
  packet.head.tick = last_.tick;
  packet.head.time = last_.time.count();
  if (!is_shown_) is_shown_ = push(packet);
  hurry();
}

void LineFeed::after_tick(const Moment& moment, const TickReport& report) {
  if (is_real_time_) note_times(report.time);
  last_ = report;
  has_ticked_ = true;
  is_shown_ = false;
  faults_.insert(faults_.end(), report.faults.begin(), report.faults.end());
  publish(moment);
}

// Another thread may take them in between: then they count for the next time, too.
void LineFeed::note_times(Nanoseconds time) {
  const auto raise = [](std::atomic<std::int64_t>& most, Nanoseconds it) {
    if (it.count() > most.load(std::memory_order_relaxed)) most = it.count();
  };
  raise(took_, real_time_() - began_);
  const std::uint64_t next = deadlines_.first_from(time);
  const bool is_on_time = next == 0 || deadlines_.at(next) == time;
  raise(late_, is_on_time ? Nanoseconds(0) : time - deadlines_.at(next - 1));
}

std::optional<LineFeed::Times> LineFeed::take_times() {
  const std::int64_t took = took_.exchange(-1), late = late_.exchange(-1);
  if (took < 0 || late < 0) return std::nullopt;
  return Times{.took = Nanoseconds(took), .late = Nanoseconds(late)};
}

// Nothing follows for a while, so what was held back is due; and so is the tick after it.
void LineFeed::standing(const Moment& moment) {
  is_due_ = !is_shown_ || wants_full_.load(std::memory_order_relaxed);
  if (has_ticked_ && is_due_) publish(moment);
  hurry();
}

void LineFeed::run_ended(const Moment& moment, const RunEnd& end) {
  end_ = packets_.end(moment, end, 0);
}

// A node that begins is asked for its progress in the next tick, so that nobody takes that of its
// last activation for it.
void LineFeed::publish(const Moment& moment) {
  if (is_due_ && wants_full_.exchange(false, std::memory_order_relaxed)) packets_.start_over();
  last_.faults = faults_;
  const Packet packet = packets_.tick(moment, last_);
  if (packets_.has_begun()) hurry();
  if (!is_due_ && !packets_.has_events()) return;
  if (push(packet)) {
    packets_.keep();
    faults_.clear();
    is_shown_ = true;
  } else if (packets_.has_events()) {
    if (lost_++ == 0) lost_from_ = last_.tick;
  }
}

bool LineFeed::push(Packet packet) {
  packet.head.lost = lost_;
  packet.head.lost_from = lost_from_;
  const bool is_in = ring_.push(packet) || (!is_real_time_ && wait_to_push(packet));
  if (is_in) lost_ = 0;
  return is_in;
}

// Time stands still meanwhile. False: nobody takes lines, or it is longer than the whole ring.
bool LineFeed::wait_to_push(const Packet& packet) {
  constexpr std::chrono::milliseconds kLook{100};
  while (has_taker_.load(std::memory_order_acquire)) {
    const std::uint32_t seen = room_made_.rung();
    is_full_.store(true);
    if (ring_.push(packet)) return true;
    if (ring_.empty()) return ring_.push(packet);
    wake_();
    room_made_.wait(seen, kLook);
  }
  return false;
}

void LineFeed::begin_taking(std::function<void()> wake) {
  wake_ = std::move(wake);
  has_taker_.store(true, std::memory_order_release);
}

void LineFeed::end_taking() {
  has_taker_.store(false, std::memory_order_release);
  room_made_.ring();
}

void LineFeed::take(std::string& lines) {
  const std::size_t begin = lines.size();
  PacketPrinter printer(ring_);
  for (auto text = printer.print(room_); !text.empty(); text = printer.print(room_)) lines += text;
  std::vector<std::string> counted;
  counts_.take(ring_, ring_.taken(), printer.finished(), counted);
  ring_.take_until(printer.finished());
  if (is_full_.exchange(false)) room_made_.ring();
  std::size_t at = begin;
  for (const std::string& counts : counted) {
    at = lines.find(json_lines::kFullEnd, at);
    lines.insert(at, counts);
    at += counts.size() + json_lines::kFullEnd.size();
  }
}

}  // namespace lockstep::host
