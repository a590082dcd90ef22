// Why a node of a recorded run has the status that it has after some tick: what `lockstep log why`
// prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "judge/summary/summary.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

struct RecordedWhy {
  std::string headline;    // "'Main/grasp' failed in tick 31"
  std::uint64_t tick = 0;  // that the answer is about; the links are of that
  std::vector<WhySummary> links =
      {};  // from the node down, or from what decided that it does not run
  std::vector<std::string> waits =
      {};  // for each link of a wait, who is held and what that waits for
};

// Reads to the tick `at`, or to the end. `node` is a path or an end of one; "" is the root. Then
// look at reader.error(). A problem: there is no such node, or no such tick.
Result<RecordedWhy> why_of(RecordingReader& reader, std::string_view node,
                           std::optional<std::uint64_t> at);

std::string to_text(const RecordedWhy& why, bool color);
std::string to_json(const RecordedWhy& why);

}  // namespace lockstep::host
