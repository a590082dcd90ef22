// The lines below a finding that say why: who waits for whom at the end of its run, and what the
// leaves do there.
#pragma once

#include <string>
#include <vector>

#include "base/core/deadlines.h"
#include "verify/verdict.h"

namespace lockstep::host {

// In one line.
inline constexpr std::size_t kMostNamesInLine = 6;

class Explainer {
 public:
  // Both must outlive this.
  Explainer(const Tree& tree, Tracer& tracer, double rate)
      : tree_(tree), tracer_(tracer), deadlines_(rate) {}

  // Who waits for whom in the end, or what is done instead.
  std::vector<std::string> why_it_stands(const Finding& finding);
  // What a run prints of a standstill. Empty: nobody waits all the time.
  std::vector<std::string> standstill_of(const Finding& finding);
  // What ends in the cycle, or else who gets ticks in it.
  std::string what_happens(const Finding& finding);
  // The tick in which something is found.
  std::string last_tick_of(const Finding& finding);

 private:
  std::string who_is_ticked(const Finding& finding);
  std::vector<std::string> ends_in(const Stepper& stepper) const;
  std::vector<std::string> ends_in(const MomentsView& moments, const Stepper& stepper) const;
  std::vector<std::string> ends_by_marks(const Stepper& stepper) const;

  const Tree& tree_;
  Tracer& tracer_;
  const Deadlines deadlines_;
};

}  // namespace lockstep::host
