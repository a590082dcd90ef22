// What a RosAction keeps of its activation for another process, which takes it up after a cut.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "action_client.hpp"
#include "expression.hpp"

namespace ros2 {

struct KeptGoal {
  // Plain members; times are those of the run.
  struct Facts {
    GoalId id = {};
    ActionClient::Sent sent = {};
    std::uint32_t number = 0;  // of the last feedback's goal
    bool is_behind = false;    // an entry of the goal has changed since
    bool is_slowed = false;    // the robot was told a pace
    double found_pace = 0;     // that it had before; NaN: not known
    double progress = 0, held_progress = 0;
    double began = 0, held_since = 0;
  };
  Facts facts;
  Expression::Memory memory;
  std::string_view goal;  // as it was sent; "": it has no room

  // Returns the number of bytes; more than `room`: nothing was written.
  std::size_t write(void* bytes, std::size_t room) const;
};

// The goal is a part of the bytes. Nothing: these are others.
std::optional<KeptGoal> read_kept_goal(std::string_view bytes, std::size_t firsts);

}  // namespace ros2
