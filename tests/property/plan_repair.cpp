#include "property/plan_repair.h"

#include <vector>

namespace lockstep::host::test {
namespace {

// The nodes from the root to a member, both included.
using Way = std::vector<Plan*>;

void find_members(Plan& node, const std::string& barrier, const GroupNames& names, Way way,
                  std::vector<Way>& found) {
  way.push_back(&node);
  if (!node.barrier.empty() && meaning(names, node.barrier) == barrier) found.push_back(way);
  const GroupNames inside = names_inside(node, names);
  for (Plan& child : node.children) find_members(child, barrier, inside, way, found);
}

// Whether two members, in document order, never meet.
bool never_meet(const Way& one, const Way& other, bool waits) {
  std::size_t common = 0;
  while (common < one.size() && one[common] == other[common]) ++common;
  if (common == one.size()) return true;  // it is inside of the first
  const std::string& kind = one[common - 1]->kind;
  return waits && (kind == "Sequence" || kind == "Fallback");
}

// The next member to take out, or null.
Plan* lonely_member(const std::vector<Way>& members, bool waits) {
  if (members.size() == 1) return members[0].back();
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (never_meet(members[j], members[i], waits)) return members[i].back();
    }
  }
  return nullptr;
}

}  // namespace

void take_out_lonely_members(Plan& plan) {
  for (const Plan& group : std::vector<Plan>(plan.beside)) {
    if (group.kind != "barrier") continue;
    for (;;) {
      std::vector<Way> members;
      find_members(plan, group.name, {}, {}, members);
      Plan* const lonely = lonely_member(members, !group.ignores_idle);
      if (lonely == nullptr) break;
      const std::vector<Plan> beside = plan.beside;  // of the root, which may be the member
      Plan child = std::move(lonely->children[0]);
      *lonely = std::move(child);
      plan.beside = beside;
    }
  }
}

bool has_lonely_members(const Plan& plan) {
  Plan repaired = plan;
  take_out_lonely_members(repaired);
  return tree_text(repaired) != tree_text(plan);
}

}  // namespace lockstep::host::test
