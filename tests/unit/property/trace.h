// Traces of a run as text, for tests of properties: a column for each node, a character for each
// tick, or each moment of one: r running, s success, f failure, i idle, k skipped, and h held.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/property/property_checks.h"

namespace lockstep::host::test {

struct TraceNode {
  std::string path;
  std::string ticks;                  // a character for each
  std::vector<double> progress = {};  // of each tick; missing: 0
};

struct TraceEntry {
  std::string key, type;
  std::vector<std::string> values;  // after each tick; "" as long as there is none
};

struct Trace {
  std::vector<TraceNode> nodes;
  std::vector<TraceEntry> entries = {};
  std::vector<std::size_t> tick_of_moments = {};  // empty: each is a tick

  std::size_t size() const { return nodes.front().ticks.size(); }
  std::size_t tick_of(std::size_t moment) const {
    return tick_of_moments.empty() ? moment : tick_of_moments[moment];
  }
  TickPart part(std::size_t moment) const {
    return {.is_first = moment == 0 || tick_of(moment - 1) != tick_of(moment),
            .is_last = moment + 1 == size() || tick_of(moment + 1) != tick_of(moment)};
  }
  PropertyNames names() const;
  SeenNode seen(std::size_t node, std::size_t tick) const;
};

// What a monitor says of the trace and of an end of that kind: "holds", "violated 3", "open". The
// number is the tick that has decided; none: the end has.
std::string verdict_of(const Property& property, const Trace& trace, RunIsOver end);

}  // namespace lockstep::host::test
