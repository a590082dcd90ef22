// A recording as a table: one row per tick and active node. docs/recording.md names the columns.
#pragma once

#include <cstdio>
#include <string_view>

#include "observers/recording_reader.h"

namespace lockstep {

// As they are, or for a terminal: as printable() makes them.
enum class CsvNames : bool { Exact, Printable };

// Writes all ticks that can be read; then look at reader.error() and reader.cut(). False when `out`
// cannot be written.
bool write_csv(RecordingReader& reader, std::FILE* out, CsvNames names = CsvNames::Exact);

// `text` in quotes if it holds a comma, a quote or a line break (RFC 4180).
std::string csv_field(std::string_view text);

}  // namespace lockstep
