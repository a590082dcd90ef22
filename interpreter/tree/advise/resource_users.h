// Finds which nodes need which resource of a pool. An entry without a start value counts as no
// resource.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/core/resource_set.h"
#include "tree/definition.h"

namespace lockstep::host {

class ResourceUsers {
 public:
  ResourceUsers(const Definition& definition, const DefinitionGroup& pool)
      : pool_(pool), users_(pool.resources.size()) {
    for (const std::uint32_t member : pool.members) {
      sets_.push_back(
          resource_list(definition.resources_of(definition.nodes[member]), pool.resources).set);
      for (std::size_t i = 0; i < users_.size(); ++i) {
        if ((sets_.back() >> i & 1u) != 0) users_[i].push_back(member);
      }
    }
  }

  ResourceSet needs(std::uint32_t member) const {
    const auto place = std::ranges::lower_bound(pool_.members, member);
    return sets_[static_cast<std::size_t>(place - pool_.members.begin())];
  }

  // One of [begin, end) that needs something of what that member needs, and that `fits`. Tries only
  // so many that a pool with many members takes no longer for each.
  template <class Fits>
  std::optional<std::uint32_t> find_rival(std::uint32_t member, std::uint32_t begin,
                                          std::uint32_t end, Fits fits) const {
    const ResourceSet needs = this->needs(member);
    for (std::size_t i = 0; i < users_.size(); ++i) {
      if ((needs >> i & 1u) == 0) continue;
      auto user = std::ranges::lower_bound(users_[i], begin);
      for (int tries = 0; tries < kMostTried && user != users_[i].end() && *user < end;
           ++tries, ++user) {
        if (*user != member && fits(*user)) return *user;
      }
    }
    return std::nullopt;
  }

  // Whether a node outside of [begin, end) needs what that member needs.
  bool has_rival_outside(std::uint32_t member, std::uint32_t begin, std::uint32_t end) const {
    const ResourceSet needs = this->needs(member);
    for (std::size_t i = 0; i < users_.size(); ++i) {
      if ((needs >> i & 1u) == 0) continue;
      if (users_[i].front() < begin || users_[i].back() >= end) return true;
    }
    return false;
  }

 private:
  static constexpr int kMostTried = 100;

  const DefinitionGroup& pool_;
  std::vector<ResourceSet> sets_;                  // of each member
  std::vector<std::vector<std::uint32_t>> users_;  // of each resource
};

}  // namespace lockstep::host
