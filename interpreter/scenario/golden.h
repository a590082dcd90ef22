// same-as="run.jsonl": the run as it was once, from the first tick to the last.
#pragma once

#include <vector>

#include "scenario/performance.h"

namespace lockstep::host {

struct Golden {
  const Performer& performer;
  const Expectation& expected;
  const PerformOptions& options;  // of the run

  // Adds what differs.
  void compare(std::vector<Surprise>& surprises) const;
  // Writes it again if it differs. True: it was written.
  bool update(std::vector<Surprise>& surprises) const;
};

}  // namespace lockstep::host
