// The parts of the library's parser of scripts. Users need none of them.
#pragma once

#include "behaviortree_cpp/scripting/script_parser.hpp"  // IWYU pragma: export
