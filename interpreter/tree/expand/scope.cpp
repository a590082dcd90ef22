#include "tree/expand/scope.h"

#include <fmt/format.h>

namespace lockstep::host {

bool Scope::passes_on(std::string_view key) const {
  return autoremap_ && (!rules_.marked_keys || !key.starts_with('_'));
}

Scope::Found Scope::find(std::string_view key) {
  if (rules_.marked_keys && key.size() > 1 && key[0] == '@') {
    Scope& top = main();
    if (!top.has_outside_) return top.find(key.substr(1));
    if (&top != this) return top.find(key);
  }
  if (const auto it = known_.find(key); it != known_.end()) return {it->second, false, {}, false};
  const auto remapped = remapped_.find(key);
  const auto text = texts_.find(key);
  const bool is_outside = remapped != remapped_.end() || (text == texts_.end() && passes_on(key));
  if (outer_ != nullptr && is_outside) {
    const Found found = outer_->find(remapped != remapped_.end() ? remapped->second : key);
    known_[key] = found.entry;
    return found;
  }
  const auto entry = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back(
      {.name = unique_name(key), .initial = {}, .typing = Typing::Any, .is_present = false});
  known_[key] = entry;
  const bool has_text = text != texts_.end();
  return {entry, true, has_text ? text->second : std::string_view(), has_text};
}

std::string Scope::unique_name(std::string_view key) {
  auto& names = main().names_;
  const auto numbered = [](std::string_view name, unsigned number) {
    return number == 1 ? std::string(name) : fmt::format("{}#{}", name, number);
  };
  for (unsigned number = 1;; ++number) {
    std::string name = outer_ == nullptr ? numbered(key, number)
                                         : fmt::format("{}/{}", numbered(path_, number_), key);
    if (names.insert(name).second) return name;
    // No other SubTree takes this number: "grasp#2/" is the name of no entry.
    if (outer_ != nullptr) {
      while (!names.insert(numbered(path_, ++number_) + "/").second) continue;
    }
  }
}

Board Scope::board() const {
  Board board{.autoremap = autoremap_, .has_outside = has_outside_};
  for (const auto& [inner, outer] : remapped_) board.remapped.emplace(inner, outer);
  for (const auto& [key, text] : texts_) board.own.emplace(key);
  for (const auto& [key, entry] : known_) {
    if (is_own(key) || (has_outside_ && key.starts_with('@'))) board.entries.emplace(key, entry);
  }
  return board;
}

std::string_view Scope::group(std::string_view name) {
  return meaning_of_group(name, true);
}

std::string_view Scope::renamed_group(std::string_view name) {
  const std::string_view meaning = meaning_of_group(name, false);
  return meaning != name && declared_.contains(meaning) ? group(name) : std::string_view();
}

std::string_view Scope::meaning_of_group(std::string_view name, bool uses_it) {
  if (uses_it) groups_.emplace(name);  // it may be of a value, and those move when some are added
  if (const auto other = texts_.find(name); outer_ != nullptr && other != texts_.end()) {
    return outer_->meaning_of_group(other->second, uses_it);
  }
  if (const auto own = group_of_file(name); !own.empty()) return own;
  return outer_ == nullptr ? name : outer_->meaning_of_group(name, uses_it);
}

std::string_view Scope::group_of_file(std::string_view name) const {
  const std::string_view outside = outer_ == nullptr ? std::string_view() : outer_->space_;
  for (std::string_view space = space_; !space.empty() && space != outside;) {
    if (const auto found = declared_.find(std::string(space) + std::string(name));
        found != declared_.end()) {
      return found->first;
    }
    space.remove_suffix(1);
    space = space.substr(0, space.rfind('.') + 1);
  }
  return {};
}

std::vector<std::string_view> Scope::open_keys() const {
  std::vector<std::string_view> keys;
  for (const auto& [key, entry] : known_) {
    if (!remapped_.contains(key) && !texts_.contains(key)) keys.push_back(key);
  }
  for (const std::string& name : groups_) {
    if (!texts_.contains(name)) keys.push_back(name);
  }
  return keys;
}

}  // namespace lockstep::host
