// What the library's parser of scripts is made of; nothing of it is for users.
#pragma once

#include "behaviortree_cpp/scripting/script_parser.hpp"  // IWYU pragma: export
