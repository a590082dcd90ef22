// Applies keys and passing time to a replay. Knows no terminal and no clock: the command line
// passes both in, and draws the result with replay_view.h.
#pragma once

#include <optional>
#include <string>

#include "base/terminal/keys.h"
#include "record/read/recording_timeline.h"

namespace lockstep::host {

class ReplayPlayer {
 public:
  static constexpr double kSlowest = 1e-3, kFastest = 1e6;

  // Begins at the current tick of the timeline, playing. `speed` 1 is as recorded.
  ReplayPlayer(RecordingTimeline& timeline, double speed);

  void press(Key key);
  // Advances the replay by this much real time.
  void pass(double seconds);
  // Real seconds until the next tick is due; nothing while no tick is.
  std::optional<double> wait() const;

  const RecordingTimeline& timeline() const { return timeline_; }
  double speed() const { return speed_; }
  bool paused() const { return paused_; }
  bool has_quit() const { return has_quit_; }
  // The number of a tick while it is typed.
  const std::optional<std::string>& typed() const { return typed_; }
  // Why the last key had no effect, or "".
  const std::string& notice() const { return notice_; }

 private:
  void press_character(char character);
  void type(Key key);
  void jump();
  void play_or_pause();
  void step(void (RecordingTimeline::*move)());
  void change_speed(double factor);
  void place_changed() { position_ = timeline_.now().time; }

  RecordingTimeline& timeline_;
  double speed_;
  bool paused_ = false;
  bool has_quit_ = false;
  double position_;  // seconds of the recording
  std::optional<std::string> typed_;
  std::string notice_;
};

}  // namespace lockstep::host
