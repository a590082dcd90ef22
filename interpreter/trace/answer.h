// An answer that somebody has given to a node that asks a person.
#pragma once

#include <cstdint>
#include <string>

#include "trace/node_state.h"

namespace lockstep::host {

struct GivenAnswer {
  NodeIndex node = 0;
  std::uint32_t number = 0;  // of the tick before which it came, as Moment::reached counts
  std::string answer = {};   // one of the options of the node
  std::string who = {};      // "terminal", "maria by the monitor"

  friend bool operator==(const GivenAnswer&, const GivenAnswer&) = default;
};

}  // namespace lockstep::host
