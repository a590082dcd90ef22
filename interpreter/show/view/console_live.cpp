#include "show/view/console_live.h"

#include <fmt/format.h>
#include <poll.h>

#include <array>
#include <new>
#include <utility>

#include "base/core/diagnostics.h"
#include "judge/summary/statistics.h"

namespace lockstep::host {

ConsoleLive::ConsoleLive(Shape shape, const LiveOptions& options, Outlet& out)
    : shape_(std::move(shape)), options_(options), out_(out), feed_(shape_), screen_(out) {}

ConsoleLive::~ConsoleLive() {
  try {
    stop();
  } catch (const std::bad_alloc&) {  // lines that will not be shown; the thread has ended
  }
}

void ConsoleLive::run_started(const Moment& moment, const RunStart& start) {
  feed_.run_started(moment, start);
  terminal_.emplace(options_.keys, out_.file());
  thread_.start([this] { draw_until_stopped(); });
}

void ConsoleLive::after_tick(const Moment& moment, const TickReport& report) {
  for (const Fault& fault : report.faults) print(fault_text(shape_, fault, report.tick));
  feed_.after_tick(moment, report);
}

void ConsoleLive::standing(const Moment& moment) {
  feed_.standing(moment);
}

void ConsoleLive::run_ended(const Moment& moment, const RunEnd& end) {
  feed_.run_ended(moment, end);
  stop();
}

void ConsoleLive::print(std::string line) {
  const std::lock_guard lock(mutex_);
  if (stopped_) {
    out_.say(printable(line) + "\n");
  } else if (printed_.size() < kMostLines) {
    printed_.push_back(std::move(line));
  } else {
    ++left_out_;
  }
}

void ConsoleLive::stop() {
  thread_.stop();
  terminal_.reset();
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  out_.say(std::exchange(above_, {}) + take_printed());
}

void ConsoleLive::draw_until_stopped() {
  do {
    draw_frame();
  } while (wait());
  press(Key{KeyKind::Escape});            // the frame that stays shows what ran in the end
  out_.flush(3 * SnapshotFeed::kPeriod);  // for the last frame there is no later one
  draw_frame();
}

// In the background nothing is drawn: the terminal belongs to others. The lines are kept.
void ConsoleLive::draw_frame() {
  const RawTerminal::State state = terminal_->take();
  is_away_ = state == RawTerminal::State::Away;
  if (is_away_) return;
  if (state == RawTerminal::State::Taken) {
    screen_.leave();
    is_due_ = true;
  }
  const TerminalSize size = terminal_size(out_.file());
  if (std::exchange(size_, size) != size) {
    is_due_ = true;
    // Nobody knows how the terminal has laid out again what was there.
    if (state == RawTerminal::State::Kept) screen_.clear();
  }
  if (above_.empty()) above_ = take_printed();
  if (!feed_.take() && above_.empty() && !is_due_) return;
  is_due_ = !screen_.show(above_, draw(shape_, feed_.newest(), draw_options()));
  if (!is_due_) above_.clear();
}

DrawOptions ConsoleLive::draw_options() const {
  return {.width = size_.width,
          .height = size_.height,
          .color = options_.color,
          .unicode = options_.unicode,
          .keys = options_.keys >= 0,
          .browsing = &browser_.browsing()};
}

bool ConsoleLive::wait() {
  const bool listens = options_.keys >= 0 && !is_away_;
  std::array<pollfd, 2> files{{{thread_.descriptor(), POLLIN, 0},
                               {listens ? options_.keys : -1, POLLIN, 0}}};  // -1 is passed over
  const int ready =
      poll(files.data(), files.size(), static_cast<int>(SnapshotFeed::kPeriod.count()));
  if (ready == 0) press(decoder_.idle());
  if (ready > 0 && files[1].revents != 0) read_keys();
  return !thread_.is_stopping();
}

void ConsoleLive::read_keys() {
  const auto keys = RawTerminal::read_keys();
  if (!keys) options_.keys = -1;  // the terminal is gone
  for (const char byte : keys.value_or("")) press(decoder_.take(byte));
}

void ConsoleLive::press(std::optional<Key> key) {
  if (key && browser_.press(*key, feed_.newest(), rows_for_nodes(draw_options()))) {
    is_due_ = true;
  }
}

std::string ConsoleLive::take_printed() {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (const std::string& line : printed_) text += printable(line) + "\n";
  if (left_out_ > 0) text += fmt::format("... {} lines left out\n", left_out_);
  printed_.clear();
  left_out_ = 0;
  return text;
}

}  // namespace lockstep::host
