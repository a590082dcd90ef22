// What a recording is of, how it ended, and the measures of its synchronized nodes, computed from
// its lines alone.
#pragma once

#include <string>

#include "recording/read/recording_reader.h"

namespace lockstep {

// Reads to the end; then look at reader.error(). A cut recording is told in the text.
std::string info_text(RecordingReader& reader, bool color = false);

}  // namespace lockstep
