// A file of MCAP that is written while the run goes on.
#pragma once

#include "record/text_encoder.h"

namespace lockstep::host {

enum class McapTimes { SinceStart, SinceEpoch };  // SinceEpoch: by the clock of the system

// Makes files of one run: they have the same start. Each chunk has what happened in at most
// kLongestChunk.
MakeEncoder mcap_encoder(McapTimes times);

}  // namespace lockstep::host
