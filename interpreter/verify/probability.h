// How likely each result is, and each property, with bounds that are proved: interval iteration
// (docs/verify.md names the papers). What has no chance may be chosen in any way that the fairness
// of docs/verify.md allows, so there is a least and a largest probability.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "verify/chance_graph.h"

namespace lockstep::host {

// The number is in it.
struct Bounds {
  double low = 0, high = 1;

  double width() const { return high - low; }
};

struct Probability {
  Bounds least, most;  // over all choices
};

struct Probabilities {
  // By status, and of a run that ends with a fault: those that some run has.
  std::array<std::optional<Probability>, kStatuses.size()> results = {};
  std::optional<Probability> fault = {};
  Probability ends;                          // that the run ends at all
  std::vector<Probability> properties = {};  // that each holds
  bool is_cut = false;  // the time was over: bounds are wider than they could be
};

// What it is worth to come to a vertex.
enum class Worth : std::uint8_t { GoesOn, Nothing, One, Unknown };
// The largest probability to come from the first vertex to some that are worth one.
Bounds largest_chance(const DecisionProcess& process, Vertex first, const std::vector<Worth>& worth,
                      const std::function<bool()>& is_over);

// `is_over` is asked now and then. Until `until`, of monotonic_now, each question has an equal
// share of the time that is left, so that one whose numbers come near slowly takes no other's.
Probabilities probabilities(const ChanceGraph& graph, const std::function<bool()>& is_over,
                            std::optional<Nanoseconds> until = {});

}  // namespace lockstep::host
