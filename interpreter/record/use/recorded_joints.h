// How the ticks of a recording follow one another, for all that measure them.
#pragma once

#include <cstdint>
#include <optional>

#include "judge/measure/measure.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

class RecordedJoints {
 public:
  explicit RecordedJoints(const RecordingReader& reader) : reader_(reader) {}

  // For each tick that the reader gives, in their order: what comes before it.
  std::optional<Joint> before(const RecordedTick& tick);

 private:
  const RecordingReader& reader_;
  std::uint64_t next_ = 0;
  std::size_t resumes_ = 0;
};

}  // namespace lockstep::host
