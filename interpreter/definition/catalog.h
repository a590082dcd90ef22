// All node types, by id: the built-in ones and the leaves of plugins.
#pragma once

#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/node_type.h"

namespace lockstep {

class Catalog {
 public:
  // The types must outlive the catalog; ids are distinct.
  void add(const NodeType* type);
  // Instead of the one with its id, if there is one.
  void replace(const NodeType* type);

  const NodeType* find(std::string_view id) const;
  std::vector<std::string_view> ids() const;                         // sorted
  std::span<const NodeType* const> types() const { return types_; }  // as added

 private:
  std::vector<const NodeType*> types_;
  std::unordered_map<std::string_view, const NodeType*> by_id_;
};

}  // namespace lockstep
