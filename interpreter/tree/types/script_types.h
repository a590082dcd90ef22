// Which types the values of a script have, as far as that is known before it runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "base/core/value.h"
#include "language/expression/expression.h"

namespace lockstep::host {

struct StaticType {
  std::optional<ValueType> type = {};  // none: not known
  const ObjectType* object = nullptr;  // of type Object: which

  friend bool operator==(const StaticType&, const StaticType&) = default;
};

// Hears how a script uses types.
struct TypeListener {
  // An assignment: the entry, in Expression::names(), and what it gets.
  std::function<void(std::uint32_t name, const StaticType& type)> assigned;
  // A part of the script that fails whenever it is reached: where in the text, and why.
  std::function<void(std::size_t offset, std::string message)> wrong;
};

// Returns the type of the script's value. `entries`: the type of each of its names.
StaticType infer_types(const Expression& script, std::span<const StaticType> entries,
                       const TypeListener& listener);

// Whether such a value may be a yes or a no.
bool may_be_yes_or_no(const StaticType& type);

}  // namespace lockstep::host
