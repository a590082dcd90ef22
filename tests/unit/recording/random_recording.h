// Recordings that no run has made: any states, gaps and faults, to read them in every way.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "record/read/recording_timeline.h"

namespace lockstep::host::test {

struct RandomRecording {
  RecordingHeader header;
  std::vector<TimelineTick> ticks;
  RecordedEnd end;  // but for how many ticks there are, and are lost

  // The file, each line with what has changed.
  std::string text() const;
};

struct RandomRecordingOptions {
  std::size_t nodes = 5;
  std::size_t ticks = 60;
  bool gaps = true;
};

RandomRecording random_recording(std::mt19937& random, const RandomRecordingOptions& options = {});
// The same but for one of its members.
RecordedState other_state(std::mt19937& random, const RecordedState& state);

}  // namespace lockstep::host::test
