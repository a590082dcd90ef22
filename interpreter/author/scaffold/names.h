// The names of what is made: which are legal, and what is made of them.
#pragma once

#include <string>
#include <string_view>

#include "base/core/problem.h"

namespace lockstep::host {

// A name of plugins, projects and trees: their files are called so.
Result<void> check_file_name(std::string_view what, std::string_view name);
// The ID of a leaf: a tag in trees, and a class in its source.
Result<void> check_node_id(std::string_view id);

// "left-arm" and "left_arm" are "LeftArm".
std::string as_class_name(std::string_view name);
// "OpenDoor" is "open_door".
std::string as_lower_name(std::string_view id);
// "OpenDoor" is "Open door".
std::string as_sentence(std::string_view id);
std::string as_upper(std::string text);

}  // namespace lockstep::host
