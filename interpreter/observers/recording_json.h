// The lines of a recording, taken apart and checked. Throws BadLine, which the reader turns into
// an error with a line number; nobody else uses this.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "observers/recording.h"

namespace lockstep {

struct BadLine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

RecordingHeader header_from(const nlohmann::json& line);
RecordedEnd end_from(const nlohmann::json& line);
RecordedGap gap_from(const nlohmann::json& line);

// Takes over the changes of one tick's line into `states`; the tick's number and time are returned.
RecordedTick tick_from(const nlohmann::json& line, std::vector<RecordedState>& states);

}  // namespace lockstep
