// The type of a start value for BehaviorTree.CPP.
#pragma once

#include <string_view>

#include "core/value.h"

namespace lockstep::btcpp {

// As which type the value of an attribute of a SubTree begins: Int, Double or String.
ValueType literal_type(std::string_view text);

}  // namespace lockstep::btcpp
