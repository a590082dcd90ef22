#include "web/feed.h"

#include <algorithm>
#include <utility>

#include "recording/write/json_lines.h"
#include "recording/write/packet_printer.h"

namespace lockstep {
namespace {

// Room for some lines that have all nodes, and for half a second of a smaller tree.
std::size_t room_for(const Tree& tree) {
  constexpr std::size_t kLines = 3, kLeast = 256u << 10;
  return std::max(kLeast, kLines * packet_size(tree.nodes.size(), kLeast / 4));
}

}  // namespace

MonitorFeed::MonitorFeed(const Tree& tree, RunDescription run, RealTime real_time)
    : real_time_(real_time),
      deadlines_(run.rate_hz),
      packets_(tree, std::move(run), json_lines()),
      ring_(room_for(tree)),
      room_(64u << 10) {}

void MonitorFeed::log(std::string_view who, std::string_view level, std::string_view text) {
  packets_.log(who, level, text);
}

void MonitorFeed::run_started(Ticker&, const RunStart& start) {
  is_real_time_ = start.real_time;
  header_ = packets_.header(start);
}

// Only a tick whose line is due asks leaves for their progress.
void MonitorFeed::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  began_ = real_time_();
  is_due_ = began_ - published_ >= kPeriod;
  if (!is_due_) return;
  published_ = began_;
  packets_.before_tick(ticker);
}

void MonitorFeed::after_tick(Ticker& ticker, const TickReport& report) {
  if (is_real_time_) note_times(report.time);
  last_ = report;
  has_ticked_ = true;
  is_shown_ = false;
  faults_.insert(faults_.end(), report.faults.begin(), report.faults.end());
  if (is_due_) publish(ticker);
}

// Another thread may take them in between: then they count for the next time, too.
void MonitorFeed::note_times(Nanoseconds time) {
  const auto raise = [](std::atomic<std::int64_t>& most, Nanoseconds it) {
    if (it.count() > most.load(std::memory_order_relaxed)) most = it.count();
  };
  raise(took_, real_time_() - began_);
  const std::uint64_t next = deadlines_.first_from(time);
  const bool is_on_time = next == 0 || deadlines_.at(next) == time;
  raise(late_, is_on_time ? Nanoseconds(0) : time - deadlines_.at(next - 1));
}

std::optional<MonitorFeed::Times> MonitorFeed::take_times() {
  const std::int64_t took = took_.exchange(-1), late = late_.exchange(-1);
  if (took < 0 || late < 0) return std::nullopt;
  return Times{.took = Nanoseconds(took), .late = Nanoseconds(late)};
}

// Nothing follows for a while, so what was held back is due; and so is the tick after it.
void MonitorFeed::standing(Ticker& ticker) {
  const bool is_due = !is_shown_ || wants_full_.load(std::memory_order_relaxed);
  if (has_ticked_ && is_due) publish(ticker);
  hurry();
}

void MonitorFeed::run_ended(Ticker& ticker, const RunEnd& end) {
  end_ = packets_.end(ticker, end, 0);
}

void MonitorFeed::publish(Ticker& ticker) {
  if (wants_full_.exchange(false, std::memory_order_relaxed)) packets_.start_over();
  last_.faults = faults_;
  if (!ring_.push(packets_.tick(ticker, last_))) return;
  packets_.keep();
  faults_.clear();
  is_shown_ = true;
}

void MonitorFeed::take(std::string& lines) {
  PacketPrinter printer(ring_, json_lines());
  for (auto text = printer.print(room_); !text.empty(); text = printer.print(room_)) lines += text;
  ring_.take_until(printer.finished());
}

}  // namespace lockstep
