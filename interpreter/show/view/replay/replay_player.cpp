#include "show/view/replay/replay_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace lockstep::host {
namespace {

bool is_digit(Key key) {
  return key.kind == KeyKind::Character && key.character >= '0' && key.character <= '9';
}

}  // namespace

ReplayPlayer::ReplayPlayer(RecordingTimeline& timeline, double speed)
    : timeline_(timeline), speed_(speed), position_(timeline.now().time) {}

void ReplayPlayer::press(Key key) {
  notice_.clear();
  if (typed_) return type(key);
  switch (key.kind) {
    case KeyKind::Character:
      return press_character(key.character);
    case KeyKind::Right:
      return step(&RecordingTimeline::step_forward);
    case KeyKind::Left:
      return step(&RecordingTimeline::step_back);
    case KeyKind::Home:
      timeline_.go_to_begin();
      return place_changed();
    case KeyKind::End:
      timeline_.go_to_end();
      return place_changed();
    default:
      return;
  }
}

void ReplayPlayer::press_character(char character) {
  switch (character) {
    case ' ':
      return play_or_pause();
    case 'n':
      return step(&RecordingTimeline::step_forward);
    case 'p':
      return step(&RecordingTimeline::step_back);
    case 'g':
      typed_.emplace();
      return;
    case '+':
    case '=':  // the same key on many keyboards
      return change_speed(2);
    case '-':
      return change_speed(0.5);
    case 'q':
      has_quit_ = true;
      return;
    default:
      return;
  }
}

void ReplayPlayer::type(Key key) {
  constexpr std::size_t kMostDigits = 19;  // fit into 64 bits
  if (is_digit(key)) {
    if (typed_->size() < kMostDigits) *typed_ += key.character;
  } else if (key.kind == KeyKind::Backspace) {
    if (!typed_->empty()) typed_->pop_back();
  } else {
    if (key.kind == KeyKind::Enter && !typed_->empty()) jump();
    typed_.reset();
  }
}

void ReplayPlayer::jump() {
  std::uint64_t tick = 0;
  const std::string& digits = *typed_;
  std::from_chars(digits.data(), digits.data() + digits.size(), tick);
  if (tick < timeline_.first_tick() || tick > timeline_.last_tick()) {
    notice_ = fmt::format("no tick {}: the recording has {} to {}", tick, timeline_.first_tick(),
                          timeline_.last_tick());
    return;
  }
  timeline_.go_to_tick(tick);
  place_changed();
  if (timeline_.now().tick != tick) {
    notice_ = fmt::format("tick {} is not in the recording; this is the last before it", tick);
  }
}

// At the end, to go on is to begin again.
void ReplayPlayer::play_or_pause() {
  paused_ = !paused_;
  if (!paused_ && timeline_.at_end()) timeline_.go_to_begin();
  place_changed();
}

void ReplayPlayer::step(void (RecordingTimeline::*move)()) {
  paused_ = true;
  (timeline_.*move)();
  place_changed();
}

void ReplayPlayer::change_speed(double factor) {
  speed_ = std::clamp(speed_ * factor, kSlowest, kFastest);
}

void ReplayPlayer::pass(double seconds) {
  if (paused_) return;
  position_ += seconds * speed_;
  // Keys must not wait for long. What this leaves undone is not caught up with: the replay is then
  // as fast as the file can be read.
  constexpr int kMostTicks = 2000;
  int ticks = 0;
  while (!timeline_.at_end() && !timeline_.failed() && timeline_.next_time() <= position_) {
    if (++ticks > kMostTicks) return place_changed();
    timeline_.step_forward();
  }
  if (timeline_.at_end()) paused_ = true;
}

std::optional<double> ReplayPlayer::wait() const {
  if (paused_ || timeline_.at_end()) return std::nullopt;
  return std::max(0.0, (timeline_.next_time() - position_) / speed_);
}

}  // namespace lockstep::host
