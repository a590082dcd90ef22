// The tree of a recording, how the run ended, and the measures of its synchronized nodes, computed
// from its lines alone.
#pragma once

#include <string>

#include "record/read/recording_reader.h"

namespace lockstep::host {

// Reads to the end; then check reader.error(). The text reports a cut recording.
std::string info_text(RecordingReader& reader, bool color = false);

}  // namespace lockstep::host
