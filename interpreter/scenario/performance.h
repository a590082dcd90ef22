// A scenario played: what came of it, against what was expected.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenario/rehearsal.h"
#include "trace/observer.h"

namespace lockstep::host {

// Something was not as expected.
struct Surprise {
  Place place = {};                    // of what was expected
  std::string message;                 // "expected success, came failure"
  std::vector<std::string> more = {};  // lines: where, and in which tick
};

struct Performance {
  RunEnd end;
  std::vector<Surprise> surprises;
  std::string problem = {};  // why the recording was not written
};

struct PerformOptions {
  std::uint64_t seed = 0;
  std::string record = {};       // a file; "": none
  Observer* observer = nullptr;  // of each tick, too
  std::function<int()> stop_signal = {};
};

class Performer {
 public:
  // Both must outlive this. The leaves of `players` belong to the rehearsal from now on; if it has
  // models, for ever.
  Performer(const Rehearsal& rehearsal, Players& players);

  // Plays it once.
  Performance perform(const PerformOptions& options) const;

 private:
  const Rehearsal& rehearsal_;
  Players& players_;
};

}  // namespace lockstep::host
