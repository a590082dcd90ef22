// An error and a hint, to which the caller adds the object and the place. A function that can fail
// returns a Result. (Diagnostics collect all errors in a tree.)
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace lockstep::host {

struct Problem {
  std::string message;    // lower case, no full stop, names in single quotes
  std::string hint = {};  // what to do, or ""
};

template <class T>
using Result = tl::expected<T, Problem>;

inline tl::unexpected<Problem> problem(std::string message, std::string hint = {}) {
  return tl::unexpected(Problem{std::move(message), std::move(hint)});
}

}  // namespace lockstep::host
