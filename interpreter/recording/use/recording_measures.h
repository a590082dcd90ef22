// The measures of a recording by the names that studies use, computed from its lines alone. What
// `lockstep log measure` prints.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/problem.h"
#include "measure/measure_spec.h"
#include "recording/read/recording_reader.h"

namespace lockstep {

struct MeasuredValue {
  std::string node;  // its path; the tree's id for what is of the run
  const MeasureSpec* measure = nullptr;
  double value = 0;           // NaN: what it is of was not reached
  std::optional<double> gap;  // where the measure has one
};

// One value for each measure, of which it keeps the address; of those that are of each parallel,
// one for each of them. Reads to the end; then look at reader.error(). Fails when a node that a
// measure names is not there.
Result<std::vector<MeasuredValue>> measure_recording(RecordingReader& reader,
                                                     std::span<const MeasureSpec> measures);

// One line: [{"node":…,"measure":…,"value":…},…]. A table with the same columns. A predictability
// has "gap" besides; what was not reached is null, or '-'.
std::string to_json(std::span<const MeasuredValue> values);
std::string to_table(std::span<const MeasuredValue> values);

}  // namespace lockstep
