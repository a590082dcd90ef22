// The properties of a recording, computed from its lines alone. `lockstep log check` prints them.
#pragma once

#include <string>

#include "language/property/property_checks.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

// Reads to the end; then check reader.error().
void check_recording(RecordingReader& reader, PropertyChecks& checks);

// A line for each property: "violated  grip  in tick 12"; then how many.
std::string to_table(const PropertyChecks& checks);
// One line: [{"name":…,"property":…,"verdict":…,"tick":…},…]; without a tick: null.
std::string to_json(const PropertyChecks& checks);

}  // namespace lockstep::host
