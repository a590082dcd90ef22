// Which types the values of a script have, as far as that is known before it runs.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "core/value.h"
#include "expression/expression.h"

namespace lockstep {

struct StaticType {
  std::optional<ValueType> type = {};  // none: not known
  const ObjectType* object = nullptr;  // of type Object: which

  friend bool operator==(const StaticType&, const StaticType&) = default;
};

// Calls `assigned` with each assignment in a script: the entry, in Expression::names(), and what it
// gets. `entries`: the type of each of the names.
using Assigned = std::function<void(std::uint32_t name, const StaticType& type)>;
void find_assignments(const Expression& script, std::span<const StaticType> entries,
                      const Assigned& assigned);

}  // namespace lockstep
