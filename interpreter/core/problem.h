// What is wrong and what to do about it, for the caller to say of what, and where. How a function
// fails that cannot go on: it returns a Result. (Diagnostics are for all that is wrong with a
// tree.)
#pragma once

#include <string>
#include <tl/expected.hpp>

namespace lockstep {

struct Problem {
  std::string message;    // lower case, no full stop, names in single quotes
  std::string hint = {};  // what to do, or ""
};

template <class T>
using Result = tl::expected<T, Problem>;

}  // namespace lockstep
