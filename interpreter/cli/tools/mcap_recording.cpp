#include "cli/run/mcap_recording.h"

#include "record/use/mcap_stream.h"

namespace lockstep::host {

MakeEncoder mcap_recording(bool is_wall) {
  return mcap_encoder(is_wall ? McapTimes::SinceEpoch : McapTimes::SinceStart);
}

}  // namespace lockstep::host
