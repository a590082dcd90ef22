// The recording format of docs/recording.md: JSON Lines. read/recording_json.h reads it.
#pragma once

#include "live/line_format.h"

namespace lockstep {

const LineFormat& json_lines();

}  // namespace lockstep
