// The measures of a recording, with the names that studies use, computed from its lines alone.
// `lockstep log measure` prints them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "judge/measure/measure.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

struct MeasuredValue {
  std::string node;  // its path; the tree's id for what is of the run
  const MeasureSpec* measure = nullptr;
  double value = 0;           // NaN: not reached
  std::optional<double> gap;  // where the measure has one
};

// One value for each measure; for a measure of each parallel, one for each parallel. Values point
// to their measures. Reads to the end; then check reader.error(). Fails if a measure names a node
// that does not exist.
Result<std::vector<MeasuredValue>> measure_recording(RecordingReader& reader,
                                                     std::span<const MeasureSpec> measures);

// One line: [{"node":…,"measure":…,"value":…},…]. A table with the same columns. A predictability
// also has "gap"; a missing value is null, or '-'.
std::string to_json(std::span<const MeasuredValue> values);
std::string to_table(std::span<const MeasuredValue> values, std::size_t width = SIZE_MAX);

}  // namespace lockstep::host
