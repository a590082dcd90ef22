// What a recording is of, how it ended, and the measures of its synchronized nodes, computed from
// its lines alone.
#pragma once

#include <cstdio>

#include "observers/recording_reader.h"

namespace lockstep {

// Reads to the end; then look at reader.error(). A cut recording is told in the text.
void write_info(RecordingReader& reader, std::FILE* out, bool color = false);

}  // namespace lockstep
