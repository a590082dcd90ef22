// A recording as a table: one row per tick and active node. docs/recording.md names the columns.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "record/read/recording_reader.h"
#include "record/tick_range.h"

namespace lockstep::host {

// Names unchanged, or, for a terminal, as printable() makes them.
enum class CsvNames : bool { Exact, Printable };

// Receives whole rows; returns false to stop.
using CsvSink = std::function<bool(std::string_view rows)>;

// Writes all readable ticks of the range; then check reader.error() and reader.cut(). Returns false
// if the sink stopped it.
bool write_csv(RecordingReader& reader, const CsvSink& write, CsvNames names = CsvNames::Exact,
               TickRange range = {});

}  // namespace lockstep::host
