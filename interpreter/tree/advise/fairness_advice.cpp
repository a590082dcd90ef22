#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/core/resource_set.h"
#include "base/core/wording.h"
#include "tree/advise/group_advice.h"

namespace lockstep::host {
namespace {

// A pool is fair to members that are reached in every tick. One that is held may find that its turn
// always comes while it is.
class FairnessAdviser {
 public:
  FairnessAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {
    for (const DefinitionGroup& group : definition.groups) {
      if (definition.is_pool(group) || !can_hold(group.node)) continue;
      for (const std::uint32_t member : group.members) barriers_.emplace(member, group.node);
    }
  }

  void advise() const {
    for (const DefinitionGroup& group : definition_.groups) {
      if (definition_.is_pool(group) && promises_fairness(group)) advise(group);
    }
  }

 private:
  struct Withheld {
    std::uint32_t member, child, holder;  // the holder withholds ticks from the child
  };

  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  bool promises_fairness(const DefinitionGroup& pool) const {
    const Value* increment = definition_.constant(at(pool.node), "increment");
    if (increment != nullptr && *increment == Value(std::int64_t{0})) return false;
    return std::ranges::none_of(
        pool.members, [&](std::uint32_t member) { return definition_.keeps(at(member)); });
  }

  // One note is enough for a pool.
  void advise(const DefinitionGroup& pool) const {
    const std::vector<Users> users = users_of(pool);
    std::optional<Withheld> first;
    std::size_t count = 0;
    for (const std::uint32_t member : pool.members) {
      const auto withheld = nearest_holder(member);
      if (!withheld) continue;
      // Nodes that are held together with the member gain nothing from that.
      const std::uint32_t child = withheld->child;
      const bool has_rival = std::ranges::any_of(users, [&](const Users& it) {
        return it.members.contains(member) && (it.first < child || it.last >= at(child).end);
      });
      if (!has_rival) continue;
      if (count++ == 0) first = withheld;
    }
    if (first) report(pool, *first, count - 1);
  }

  // The members that need a resource. An entry without a start value counts as no resource.
  struct Users {
    std::uint32_t first = 0, last = 0;
    std::set<std::uint32_t> members = {};
  };
  std::vector<Users> users_of(const DefinitionGroup& pool) const {
    std::vector<Users> users(pool.resources.size());
    for (const std::uint32_t member : pool.members) {
      const ResourceSet set = all_resources(
          resource_list(definition_.resources_of(at(member)), pool.resources).request());
      for (std::size_t i = 0; i < users.size(); ++i) {
        if ((set >> i & 1u) == 0) continue;
        if (users[i].members.empty()) users[i].first = member;
        users[i].last = member;
        users[i].members.insert(member);
      }
    }
    return users;
  }

  std::optional<Withheld> nearest_holder(std::uint32_t member) const {
    for (std::uint32_t child = member; child != at(child).parent; child = at(child).parent) {
      if (const auto holder = holder_of_children(at(child).parent)) {
        return Withheld{member, child, *holder};
      }
    }
    return std::nullopt;
  }

  // A synchronized node withholds ticks from its children, a barrier from those of its members.
  std::optional<std::uint32_t> holder_of_children(std::uint32_t node) const {
    if (at(node).type->category == NodeCategory::Control) {
      const bool holds = compares_progress(at(node).type->synchronization) && can_hold(node);
      return holds ? std::optional(node) : std::nullopt;
    }
    const auto barrier = barriers_.find(node);
    return barrier == barriers_.end() ? std::nullopt : std::optional(barrier->second);
  }

  // Limits from an entry may be anywhere.
  bool can_hold(std::uint32_t holder) const {
    constexpr double kTolerance = 1e-9;
    if (definition_.synchronization(at(holder)) == Synchronization::Relative) {
      const Value* delta = definition_.constant(at(holder), "delta");
      return delta == nullptr || std::get<double>(*delta) < 1 - kTolerance;
    }
    const Value* barriers = definition_.constant(at(holder), "barriers");
    if (barriers == nullptr) return true;
    const auto& list = std::get<std::vector<double>>(*barriers);
    return !list.empty() && list.front() < 1 - kTolerance;
  }

  void report(const DefinitionGroup& pool, const Withheld& it, std::size_t others) const {
    const std::string more = others == 0 ? "" : fmt::format(", and to {} more", others);
    const std::uint32_t around = at(it.child).parent;
    report_.at("unfair-pool"_code, at(it.member).place,
               fmt::format("'{}' is not fair to '{}', from which '{}' withholds ticks{}",
                           brief(at(pool.node).name), brief(at(it.member).name),
                           brief(at(it.holder).name), more),
               fmt::format("its turn may come only in ticks that it does not get; a UseResources "
                           "around '{}' gets its turn",
                           brief(at(around).name)),
               Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
  std::unordered_map<std::uint32_t, std::uint32_t> barriers_;  // of each SyncProgress
};

}  // namespace

void note_unfairness(const Definition& definition, const Reporter& report) {
  FairnessAdviser(definition, report).advise();
}

}  // namespace lockstep::host
