// BlackboardCheckInt, -Double, -Bool and -String of version 3: a decorator that ticks its child
// while two values are equal. Both languages say it as a WhileDoElse.
#pragma once

#include <cstdint>
#include <string>

#include "language/document/document.h"

namespace lockstep::host {

bool is_blackboard_check(std::string_view type);

// What stands around the child, or why it cannot be said.
struct ConvertedCheck {
  std::string code = {};       // a script of both languages
  std::string otherwise = {};  // the node of the result if it is false
  std::string problem = {}, hint = {};
  Place place = {};  // of what is the problem
};

ConvertedCheck converted_check(const Document& document, std::uint32_t element,
                               std::string_view type);

// Whether it has become one of the three.
bool is_attribute_of_check(std::string_view name);

}  // namespace lockstep::host
