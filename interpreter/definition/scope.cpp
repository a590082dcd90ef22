#include "definition/scope.h"

namespace lockstep {

Scope::Found Scope::find(std::string_view key) {
  if (const auto it = known_.find(key); it != known_.end()) return {it->second, false, {}, false};
  const auto remapped = remapped_.find(key);
  const auto text = texts_.find(key);
  const bool passes_on = remapped != remapped_.end() || (autoremap_ && text == texts_.end());
  if (outer_ != nullptr && passes_on) {
    const Found found = outer_->find(remapped != remapped_.end() ? remapped->second : key);
    known_[key] = found.entry;
    return found;
  }
  const auto entry = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back({.name = prefix_ + std::string(key), .type = {}, .initial = {}});
  known_[key] = entry;
  const bool has_text = text != texts_.end();
  return {entry, true, has_text ? text->second : std::string_view(), has_text};
}

std::string_view Scope::group(std::string_view name) {
  if (outer_ == nullptr) return name;
  groups_.insert(name);
  const auto other = texts_.find(name);
  return outer_->group(other == texts_.end() ? name : other->second);
}

std::vector<std::string_view> Scope::open_keys() const {
  std::vector<std::string_view> keys;
  for (const auto& [key, entry] : known_) {
    if (!remapped_.contains(key) && !texts_.contains(key)) keys.push_back(key);
  }
  for (const std::string_view name : groups_) {
    if (!texts_.contains(name)) keys.push_back(name);
  }
  return keys;
}

}  // namespace lockstep
