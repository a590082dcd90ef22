#include "tree/catalog.h"

#include <algorithm>

namespace lockstep::host {

void Catalog::add(const NodeType* type) {
  types_.push_back(type);
  by_id_.emplace(type->id, type);
}

void Catalog::replace(const NodeType* type) {
  if (by_id_.erase(type->id) != 0) {
    std::erase_if(types_, [&](const NodeType* it) { return it->id == type->id; });
  }
  add(type);
}

const NodeType* Catalog::find(std::string_view id) const {
  const auto it = by_id_.find(id);
  return it == by_id_.end() ? nullptr : it->second;
}

std::vector<std::string_view> Catalog::ids() const {
  std::vector<std::string_view> ids;
  for (const auto& entry : by_id_) ids.push_back(entry.first);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace lockstep::host
