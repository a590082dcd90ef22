// Barriers that never open because each waits for the next: its last member is after a member of
// another barrier in a Sequence, which in turn waits for a member that is after one of the first.
#pragma once

#include <cstdint>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

// A member of `group` is in an earlier child of `sequence` than one of `next`. Nodes of the
// definition.
struct WaitingLink {
  std::uint32_t group, next, sequence;
};

// The first circle that is found, or nothing. Only of barriers that wait for idle members.
std::vector<WaitingLink> waiting_circle(const Definition& definition);

}  // namespace lockstep::host
