// A value of a type, in place.
#pragma once

#include <variant>

#include "base/core/value.h"

namespace lockstep::host {

// The T that `value` holds, made when it holds another: what has capacity keeps it.
template <class T>
T& held(Value& value) {
  T* const found = std::get_if<T>(&value);
  return found != nullptr ? *found : value.emplace<T>();
}

}  // namespace lockstep::host
