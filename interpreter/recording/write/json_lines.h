// The recording format of docs/recording.md: JSON Lines. read/recording_json.h reads it.
#pragma once

#include "recording/write/recording_format.h"

namespace lockstep {

const RecordingFormat& json_lines();

}  // namespace lockstep
