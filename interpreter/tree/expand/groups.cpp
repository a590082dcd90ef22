#include "tree/expand/groups.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"
#include "tree/advise/waiting_circle.h"

namespace lockstep::host {
namespace {

class GroupChecker {
 public:
  GroupChecker(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void check() const {
    bool all_meet = true;
    for (const DefinitionGroup& group : definition_.groups) {
      if (!compares_progress(at(group.node).type->synchronization)) continue;
      all_meet &= check_members(group);
    }
    if (!all_meet) return;
    if (const auto circle = waiting_circle(definition_); !circle.empty()) report_circle(circle);
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }
  std::string name(std::uint32_t node) const { return brief(at(node).name); }
  std::string where(std::uint32_t node) const {
    return to_text(report_.sources().locate(at(node).place));
  }

  // One error is enough for a barrier.
  bool check_members(const DefinitionGroup& group) const {
    const auto& members = group.members;
    if (members.size() == 1) {
      report_.at("lone-member"_code, at(members[0]).place,
                 fmt::format("no other node waits at the barrier '{}'", name(group.node)),
                 "a barrier needs a SyncProgress for each of those that wait for each other");
      return false;
    }
    for (std::size_t i = 1; i < members.size(); ++i) {
      if (!can_meet(group, members[i - 1], members[i])) return false;
    }
    return true;
  }

  // Neighbors in pre-order: if any two members are in different children of a node, two neighbors
  // are.
  bool can_meet(const DefinitionGroup& group, std::uint32_t one, std::uint32_t other) const {
    if (other < at(one).end) {
      report_.at(
          "deadlock"_code, at(other).place,
          fmt::format("a member of the barrier '{}' is inside another one", name(group.node)),
          fmt::format("the outer one, at {}, would wait for itself", where(one)));
      return false;
    }
    const std::uint32_t pair[] = {one, other};
    const std::uint32_t ancestor = definition_.common_ancestor(pair);
    if (at(ancestor).type->goes_on_after == Status::Idle || !definition_.waits(group)) return true;
    report_.at("members-never-meet"_code, at(other).place,
               fmt::format("this member of the barrier '{}' never meets the one at {}",
                           name(group.node), where(one)),
               fmt::format("they are in different children of the {} '{}', which run one after the "
                           "other; idle=\"ignore\" waits only for members that run",
                           at(ancestor).type->id, name(ancestor)));
    return false;
  }

  void report_circle(const std::vector<WaitingLink>& circle) const {
    constexpr std::size_t kMostExplained = 4;
    std::vector<std::string_view> names;
    std::string hint;
    for (const WaitingLink& link : circle) {
      names.push_back(at(link.group).name);
      if (names.size() > kMostExplained) continue;
      hint += fmt::format("{}'{}' comes before '{}' in the {} at {}", hint.empty() ? "" : "; ",
                          name(link.group), name(link.next), at(link.sequence).type->id,
                          where(link.sequence));
    }
    names.push_back(names.front());
    report_.at("deadlock"_code, at(circle.front().group).place,
               fmt::format("barriers wait for each other: {}", chained(names)), hint);
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void check_groups(const Definition& definition, const Reporter& report) {
  GroupChecker(definition, report).check();
}

}  // namespace lockstep::host
