// The names of the operators of scripts in messages.
#pragma once

#include <string_view>

#include "language/expression/program.h"

namespace lockstep::host {

// What a condition may be.
inline constexpr std::string_view kCondition =
    "true, false, 0, 1 or a number that is not negative and not whole";

// As it is written. `relation` is that of a comparison.
std::string_view sign_of(Operation operation, Relation relation);
// The operands that it takes: "two numbers".
std::string_view operands_of(Operation operation);

}  // namespace lockstep::host
