// Conditions at which a run pauses: `run --break-if 'left.progress > 0.4 and not right.held'`. They
// are what properties say of a tick (docs/properties.md).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "judge/measure/property_steps.h"
#include "language/property/property.h"
#include "trace/moment.h"

namespace lockstep::host {

// The property that such a condition is never true, which the first tick with it violates.
Property::Parsed parse_break_condition(std::string_view text, const PropertyNames& names);

class BreakConditions {
 public:
  // Of parse_break_condition().
  explicit BreakConditions(std::vector<Property> conditions);

  // What the Moments of the run must have.
  AskedOfRun asked() const;
  // The text of the first that has become true in this tick; "": none has. Does not allocate.
  std::string_view after_tick(const Moment& moment);

 private:
  struct Watched {
    explicit Watched(Property condition);

    Property property;
    std::vector<SeenNode> seen;
    std::unique_ptr<bool[]> compared;
    std::vector<std::byte> state;
    bool was_true = false;  // in the last tick
  };
  bool is_true(Watched& watched, const Moment& moment);

  std::vector<Watched> watched_;
  MomentSteps steps_;
  std::string room_;
};

}  // namespace lockstep::host
