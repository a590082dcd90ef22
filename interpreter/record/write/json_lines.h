// The recording format of docs/recording.md: JSON Lines. read/recording_json.h reads it.
#pragma once

#include "record/live/live_format.h"

namespace lockstep::host {

const LiveFormat& json_lines();

}  // namespace lockstep::host
