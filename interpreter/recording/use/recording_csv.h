// A recording as a table: one row per tick and active node. docs/recording.md names the columns.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "recording/read/recording_reader.h"

namespace lockstep {

// As they are, or for a terminal: as printable() makes them.
enum class CsvNames : bool { Exact, Printable };

// Takes whole rows; false: no more of them.
using CsvSink = std::function<bool(std::string_view rows)>;

// Writes all ticks that can be read; then look at reader.error() and reader.cut(). False when the
// sink took no more.
bool write_csv(RecordingReader& reader, const CsvSink& write, CsvNames names = CsvNames::Exact);

}  // namespace lockstep
