#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/core/wording.h"
#include "tree/advise/group_advice.h"
#include "tree/advise/progress_parts.h"
#include "tree/advise/resource_users.h"
#include "tree/advise/withholding.h"

namespace lockstep::host {
namespace {

// A member with keep="true" owns its resources also while it is held. If it is held until another
// one advances that needs them, both wait for ever.
class KeepAdviser {
 public:
  KeepAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report), withholding_(definition), parts_(definition) {}

  void advise() {
    find_ties();
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group)) advise(group);
    }
  }

 private:
  static constexpr std::size_t kMostTold = 10;    // of a pool
  static constexpr std::size_t kMostTried = 100;  // others for each: many are no slower

  // A member of a pool inside of a member of a barrier, or around it.
  struct Tie {
    std::uint32_t user, member;
  };
  using PoolAndBarrier = std::pair<std::uint32_t, std::uint32_t>;

  // `holder` may hold the keeper until `other` is there.
  struct Deadlock {
    std::uint32_t holder, other;
  };

  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }
  bool is_below(std::uint32_t node, std::uint32_t top) const {
    return top < node && node < at(top).end;
  }

  void find_ties() {
    for (const DefinitionGroup& group : definition_.groups) {
      if (!definition_.is_pool(group)) continue;
      for (const std::uint32_t user : group.members) {
        pools_.emplace(user, group.node);
        find_barriers_around(user, group.node);
      }
    }
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group) || !withholding_.can_hold(group.node)) continue;
      for (const std::uint32_t member : group.members) find_pools_around(member, group.node);
    }
  }

  void find_barriers_around(std::uint32_t user, std::uint32_t pool) {
    for (std::uint32_t node = user; node != at(node).parent;) {
      node = at(node).parent;
      const std::uint32_t holder = withholding_.of_children(node);
      if (withholding_.is_barrier(holder)) ties_[{pool, holder}].push_back({user, node});
    }
  }

  void find_pools_around(std::uint32_t member, std::uint32_t barrier) {
    for (std::uint32_t node = member; node != at(node).parent;) {
      node = at(node).parent;
      const auto pool = pools_.find(node);
      if (pool != pools_.end()) ties_[{pool->second, barrier}].push_back({node, member});
    }
  }

  void advise(const DefinitionGroup& pool) {
    const ResourceUsers users(definition_, pool);
    told_.clear();
    for (const std::uint32_t keeper : pool.members) {
      if (!definition_.keeps(at(keeper)) || told_.size() == kMostTold) continue;
      if (const auto deadlock = in_parallel(users, keeper)) report(pool, users, keeper, *deadlock);
    }
    auto ties = ties_.lower_bound({pool.node, 0});
    for (; ties != ties_.end() && ties->first.first == pool.node; ++ties) {
      at_barrier(pool, users, ties->first.second, ties->second);
    }
  }

  // Both are in different children of a synchronized node.
  std::optional<Deadlock> in_parallel(const ResourceUsers& users, std::uint32_t keeper) const {
    for (std::uint32_t child = keeper; child != at(child).parent; child = at(child).parent) {
      const std::uint32_t holder = withholding_.of_children(at(child).parent);
      if (holder != at(child).parent) continue;
      const ProgressPart kept = parts_.part(keeper, child);
      const auto fits = [&](std::uint32_t other) {
        return withholding_.can_hold(holder, kept.begin, kept.end, begin_of(other, holder));
      };
      auto other = users.find_rival(keeper, holder, child, fits);
      if (!other) other = users.find_rival(keeper, at(child).end, at(holder).end, fits);
      if (other) return Deadlock{holder, *other};
    }
    return std::nullopt;
  }

  // The progress of that node's child at which its part begins.
  double begin_of(std::uint32_t user, std::uint32_t top) const {
    std::uint32_t child = user;
    while (at(child).parent != top) child = at(child).parent;
    return parts_.part(user, child).begin;
  }

  // Both have to do with members of one barrier.
  void at_barrier(const DefinitionGroup& pool, const ResourceUsers& users, std::uint32_t barrier,
                  const std::vector<Tie>& ties) {
    for (const Tie& tie : ties) {
      if (!definition_.keeps(at(tie.user)) || told_.size() == kMostTold) continue;
      const auto other = awaited(users, ties, tie, barrier);
      if (other) report(pool, users, tie.user, {barrier, *other});
    }
  }

  std::optional<std::uint32_t> awaited(const ResourceUsers& users, const std::vector<Tie>& ties,
                                       const Tie& own, std::uint32_t barrier) const {
    const ProgressPart kept = part_in_member(own);
    for (std::size_t i = 0; i < std::min(ties.size(), kMostTried); ++i) {
      const Tie& other = ties[i];
      if (other.user == own.user || other.member == own.member) continue;
      if ((users.needs(other.user) & users.needs(own.user)) == 0) continue;
      if (withholding_.can_hold(barrier, kept.begin, kept.end, part_in_member(other).begin)) {
        return other.user;
      }
    }
    return std::nullopt;
  }

  // A user that is around the member is needed for all of its progress.
  ProgressPart part_in_member(const Tie& tie) const {
    return is_below(tie.user, tie.member) ? parts_.part(tie.user, tie.member) : ProgressPart();
  }

  void report(const DefinitionGroup& pool, const ResourceUsers& users, std::uint32_t keeper,
              const Deadlock& it) {
    if (!told_.insert(keeper).second) return;
    const std::string_view other = at(it.other).name, holder = at(it.holder).name;
    const ResourceSet common = users.needs(keeper) & users.needs(it.other);
    report_.at(at(keeper).place,
               fmt::format("'{}' and '{}' may wait for each other for ever", brief(at(keeper).name),
                           brief(other)),
               fmt::format("'{}' holds '{}' until '{}' at {} has come as far, which waits for {} "
                           "of '{}' as long as '{}' keeps it; leave out keep=\"true\"",
                           brief(holder), brief(at(keeper).name), brief(other),
                           to_text(report_.sources().locate(at(it.other).place)),
                           to_text(common, pool.resources), brief(at(pool.node).name),
                           brief(at(keeper).name)),
               Severity::Warning);
  }

  const Definition& definition_;
  const Reporter& report_;
  const Withholding withholding_;
  const ProgressParts parts_;
  std::unordered_map<std::uint32_t, std::uint32_t> pools_;  // of each UseResources
  std::map<PoolAndBarrier, std::vector<Tie>> ties_;
  std::set<std::uint32_t> told_;  // the keepers of the pool
};

bool has_keeper(const Definition& definition) {
  return std::ranges::any_of(definition.groups, [&](const DefinitionGroup& group) {
    return definition.is_pool(group) && group.members.size() > 1 &&
           std::ranges::any_of(group.members, [&](std::uint32_t member) {
             return definition.keeps(definition.nodes[member]);
           });
  });
}

}  // namespace

void warn_of_keepers(const Definition& definition, const Reporter& report) {
  if (has_keeper(definition)) KeepAdviser(definition, report).advise();
}

}  // namespace lockstep::host
