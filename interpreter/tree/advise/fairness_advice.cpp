#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/core/wording.h"
#include "tree/advise/group_advice.h"
#include "tree/advise/resource_users.h"
#include "tree/advise/withholding.h"

namespace lockstep::host {
namespace {

// A pool is fair to members that are reached in every tick. One that is held may find that its turn
// always comes while it is.
class FairnessAdviser {
 public:
  FairnessAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report), withholding_(definition) {}

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
    const ResourceUsers users(definition_, pool);
    std::optional<Withheld> first;
    std::size_t count = 0;
    for (const std::uint32_t member : pool.members) {
      const auto withheld = nearest_holder(member);
      if (!withheld) continue;
      // Nodes that are held together with the member gain nothing from that.
      const std::uint32_t child = withheld->child;
      if (!users.has_rival_outside(member, child, at(child).end)) continue;
      if (count++ == 0) first = withheld;
    }
    if (first) report(pool, *first, count - 1);
  }

  std::optional<Withheld> nearest_holder(std::uint32_t member) const {
    for (std::uint32_t child = member; child != at(child).parent; child = at(child).parent) {
      const std::uint32_t holder = withholding_.of_children(at(child).parent);
      if (holder != Withholding::kNobody) return Withheld{member, child, holder};
    }
    return std::nullopt;
  }

  void report(const DefinitionGroup& pool, const Withheld& it, std::size_t others) const {
    const std::string more = others == 0 ? "" : fmt::format(", and to {} more", others);
    const std::uint32_t around = at(it.child).parent;
    report_.at(at(it.member).place,
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
  const Withholding withholding_;
};

}  // namespace

void note_unfairness(const Definition& definition, const Reporter& report) {
  FairnessAdviser(definition, report).advise();
}

}  // namespace lockstep::host
