// `run --record FILE.mcap`: what makes MCAP of a recording.
#pragma once

#include "record/text_encoder.h"

namespace lockstep::host {

// Times are since 1970 on the clock of the robot, else since the start of the run. None: this
// lockstep knows no MCAP.
MakeEncoder mcap_recording(bool is_wall);

}  // namespace lockstep::host
