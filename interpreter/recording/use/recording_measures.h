// The measures of a recording by the names that studies use, computed from its lines alone. What
// `lockstep log measure` prints.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measure_spec.h"
#include "recording/read/recording_reader.h"

namespace lockstep {

struct MeasuredValue {
  std::string node;  // its path; of a duration, the tree
  MeasureSpec measure;
  double value = 0;           // NaN: what it is of was not reached
  std::optional<double> gap;  // of a predictability: see Predictability::gap()
};

// One value for each measure; of those that are of a synchronized node, one for each such node.
// Reads to the end; then look at reader.error(). `error`: a node that a measure names is not there.
std::vector<MeasuredValue> measure_recording(RecordingReader& reader,
                                             std::span<const MeasureSpec> measures,
                                             std::string& error);

// One line: [{"node":…,"measure":…,"value":…},…]. A table with the same columns. A predictability
// has "gap" besides; what was not reached is null, or '-'.
std::string to_json(std::span<const MeasuredValue> values);
std::string to_table(std::span<const MeasuredValue> values);

}  // namespace lockstep
