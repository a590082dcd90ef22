#include "property/reference_group.h"

#include <algorithm>
#include <stdexcept>

namespace lockstep::host::test {
ReferenceGroup::ReferenceGroup(Reference& tree, const Plan& its_plan, ReferenceNode& root)
    : ReferenceNode(tree, its_plan) {
  find_members(root, {}, {});
  world.groups.push_back(this);
}

void ReferenceGroup::find_members(ReferenceNode& node, Way way, const GroupNames& names) {
  way.push_back(&node);
  const std::string& written = node.plan.barrier.empty() ? node.plan.pool : node.plan.barrier;
  if (!written.empty() && meaning(names, written) == plan.name) {
    ways_.push_back(way);
    if (written != plan.name) note("a member of a group that is remapped");
  }
  const GroupNames inside = names_inside(node.plan, names);
  for (auto& child : node.children) find_members(*child, way, inside);
}

std::size_t ReferenceGroup::ancestor_depth() const {
  std::size_t depth = 0;
  const auto all_pass = [&](std::size_t level) {
    return std::ranges::all_of(ways_, [&](const Way& way) {
      return level + 1 < way.size() && way[level] == ways_[0][level];
    });
  };
  while (all_pass(depth + 1)) ++depth;
  return depth;
}

bool ReferenceGroup::is_inside_of(const ReferenceGroup& other) const {
  return std::ranges::any_of(ways_, [&](const Way& way) {
    return std::ranges::any_of(other.ways_, [&](const Way& outer) {
      return way.size() > outer.size() && way[outer.size() - 1] == outer.back();
    });
  });
}

std::size_t ReferenceGroup::place_of(const ReferenceNode& member) const {
  for (std::size_t place = 0; place < ways_.size(); ++place) {
    if (ways_[place].back() == &member) return place;
  }
  return ways_.size();
}

void ReferenceGroup::after_tick() {
  if (!ancestor().runs() && runs()) status = Status::Idle;
}

Status ReferenceGroup::on_tick(bool) {
  throw std::logic_error("a group is not in the tree");
}

}  // namespace lockstep::host::test
