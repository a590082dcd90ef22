// A recording as MCAP, which Foxglove and PlotJuggler open beside the data of a robot: topics and
// messages in docs/recording.md. Written while the recording is read.
#pragma once

#include "record/read/recording_reader.h"
#include "record/tick_range.h"
#include "record/use/export_sink.h"

namespace lockstep::host {

struct McapOptions {
  TickRange range;
  double start_time =
      0;  // Unix time of the begin of the run, in seconds; 0: times are those of the run
};

// Then check reader.error(). Returns false if the sink stopped it. Throws a std::runtime_error if
// there is no libzstd.
bool write_mcap(RecordingReader& reader, const McapOptions& options, const ExportSink& write);

}  // namespace lockstep::host
