// A recording as a trace that Perfetto and Chrome open: JSON, docs/recording.md. A track for each
// node has slices; those of one track nest. Written while the recording is read: memory for the
// tree only.
#pragma once

#include "record/read/recording_reader.h"
#include "record/tick_range.h"
#include "record/use/export_sink.h"

namespace lockstep::host {

// Then check reader.error(). Returns false if the sink stopped it.
bool write_trace(RecordingReader& reader, TickRange range, const ExportSink& write);

}  // namespace lockstep::host
