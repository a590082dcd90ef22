// The ways in which a robot is held while a synchronized node withholds ticks from its leaf.
#pragma once

#include <string>

#include "result.hpp"
#include "target.hpp"

namespace ros2 {

struct Hold {
  enum class Way { Undecided, Nothing, Cancel, Tell, Pace };
  Way way = Way::Undecided;
  Target target = {};  // of Tell: it gets true, then false
};

// hold="cancel", "service:NAME", "topic:NAME", "pace", "nothing"; `type` is that of the service or
// topic, "" for the usual one.
Result<Hold> read_hold(const std::string& text, const std::string& type);

}  // namespace ros2
