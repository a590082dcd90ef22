// The interfaces of the packages on AMENT_PREFIX_PATH, and their type supports.
#pragma once

#include <string>
#include <vector>

#include "result.hpp"

namespace ros2 {

// "nav2_msgs/action/NavigateToPose": the parts of a type's name.
struct TypeName {
  std::string package, kind, name;
  std::string text() const { return package + "/" + kind + "/" + name; }
};

// `kind` is "action", "srv" or "msg".
Result<TypeName> parse_type_name(const std::string& text, const std::string& kind);

// The result of the type's get_…_type_support_handle. The library stays loaded.
Result<const void*> type_support(const TypeName& type);
// That of the goal of an action, as a message.
Result<const void*> goal_support(const TypeName& action);

// Its definition as IDL, which every package of interfaces installs; "" when there is none.
std::string interface_file(const TypeName& type);

// "; did you mean 'x'?", or what there is.
std::string suggestion(const std::string& wrong, const std::vector<std::string>& known);

}  // namespace ros2
