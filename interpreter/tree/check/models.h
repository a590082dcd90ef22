// The models of a project: what <TreeNodesModel> says about ports, for editors. Those of SubTrees
// also count when the tree is loaded; those of leaves are hints about what no plugin has.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/core/node_type.h"
#include "language/document/project.h"
#include "language/document/reporter.h"

namespace lockstep::host {

struct ModelPort {
  std::string_view name;
  std::string_view type;  // as in C++; "" if it is not said
  std::optional<std::string_view> default_value;
  Direction direction;
};

struct Model {
  NodeCategory category;
  std::vector<ModelPort> ports;

  const ModelPort* port(std::string_view name) const {
    const auto found = std::ranges::find(ports, name, &ModelPort::name);
    return found == ports.end() ? nullptr : &*found;
  }
};

// By ID; a later one replaces an earlier one.
struct Models {
  std::map<std::string_view, Model> nodes;
  std::map<std::string_view, Model> subtrees;
};

Models read_models(const Project& project, const Reporter& report);

// The type of values that a C++ type has here; nothing where it has none.
std::optional<ValueType> type_of_cpp(std::string_view name);
// The other way round; the first one of type_of_cpp.
std::string_view cpp_type_of(ValueType type);

}  // namespace lockstep::host
