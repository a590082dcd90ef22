#include "hold.hpp"

namespace ros2 {

Result<Hold> read_hold(const std::string& text, const std::string& type) {
  if (text.empty()) return Hold{};
  if (text == "nothing") return Hold{Hold::Way::Nothing};
  if (text == "cancel") return Hold{Hold::Way::Cancel};
  if (text == "pace") return Hold{Hold::Way::Pace};
  auto target = target_named(text);
  if (!target || target->way == Target::Way::Parameter) {
    return Problem{"'" + text + "' is no way to hold a robot",
                   "write cancel (the goal is canceled and sent again), service:NAME or topic:NAME "
                   "(which tell the robot), pace (it gets the pace 0), or nothing (the robot goes "
                   "on)"};
  }
  const bool is_service = target->way == Target::Way::Service;
  const std::string usual = is_service ? "std_srvs/srv/SetBool" : "std_msgs/msg/Bool";
  if (auto problem = find_type(*target, type.empty() ? usual : type, {Field::Kind::Bool},
                               "bool, which is to say whether the robot holds still")) {
    if (problem->hint.empty()) problem->hint = usual + " has one";
    return *problem;
  }
  return Hold{Hold::Way::Tell, *target};
}

}  // namespace ros2
