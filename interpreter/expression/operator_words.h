// What messages call the operators of scripts.
#pragma once

#include <string_view>

#include "expression/program.h"

namespace lockstep::host {

// As it is written. `relation` is that of a comparison.
std::string_view sign_of(Operation operation, Relation relation);
// What it takes: "two numbers".
std::string_view operands_of(Operation operation);

}  // namespace lockstep::host
