// The statements of plugins about what the leaves of their types do: leaf.h has them as texts.
#pragma once

#include <string_view>
#include <vector>

#include "base/core/node_type.h"

namespace lockstep::host {

// A word of a leaf file and its value; base/core/behavior.h reads it.
struct Statement {
  std::string_view word, value;
};

// They were checked when the plugin was loaded.
std::vector<Statement> declared_behavior(const NodeType& type);

}  // namespace lockstep::host
