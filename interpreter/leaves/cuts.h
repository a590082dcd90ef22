// Where the progress of a leaf matters: what the nodes above compare it with, taken down through
// the progress that each of them computes (docs/nodes-and-attributes.md).
#pragma once

#include <map>
#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

// The cuts of one node.
struct Cuts {
  std::vector<double> at;      // in (0, 1], rising: it is asked whether its progress is there yet
  std::vector<double> behind;  // in [0, 1), rising: the same, whether it is further than this
  std::vector<double> deltas;  // it is compared with others that are so far away
  bool is_unknown = false;     // something above compares it with what is not known

  // In (0, 1]: with 0, one value of each part of the way whose values all compare alike.
  std::vector<double> levels() const;
};

// The barriers that an entry may hold, by slot. An entry that is not there is unknown.
using BarriersOfEntries = std::map<std::uint32_t, std::vector<double>>;

// The cuts of each node.
std::vector<Cuts> cuts_of(const Tree& tree, const BarriersOfEntries& entries,
                          std::span<const Observed::Progress> compared = {});

}  // namespace lockstep::host
