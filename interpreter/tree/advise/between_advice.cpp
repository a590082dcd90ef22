// Notes nodes with hold="between" that have nothing in them which looks between its children.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tree/advise/group_advice.h"

namespace lockstep::host {
namespace {

class BetweenAdviser {
 public:
  BetweenAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report), looking_(definition.nodes.size() + 1) {
    const auto& nodes = definition.nodes;
    std::vector<bool> has_action(nodes.size());
    for (std::size_t node = nodes.size(); node-- > 0;) {
      if (nodes[node].type->category == NodeCategory::Action) has_action[node] = true;
      if (has_action[node]) has_action[nodes[node].parent] = true;
    }
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const bool looks = nodes[node].type->goes_on_after == Status::Success &&
                         nodes[node].children > 1 && has_action[node];
      looking_[node + 1] = looking_[node] + (looks ? 1 : 0);
    }
  }

  void advise() const {
    for (std::uint32_t node = 0; node < definition_.nodes[0].end; ++node) {
      const DefinitionNode& it = definition_.nodes[node];
      if (definition_.holds_between(it) && !looks_in(node)) note(it);
    }
    for (const DefinitionGroup& group : definition_.groups) {
      const DefinitionNode& node = definition_.nodes[group.node];
      if (!definition_.holds_between(node)) continue;
      if (std::ranges::none_of(group.members, [&](auto member) { return looks_in(member); }))
        note(node);
    }
  }

 private:
  bool looks_in(std::uint32_t node) const {
    return looking_[definition_.nodes[node].end] != looking_[node];
  }

  void note(const DefinitionNode& node) const {
    report_.at(
        "unused-hold"_code, node.place,
        fmt::format("hold=\"between\" of '{}' has no effect: no Sequence is held by it", node.name),
        "it looks before a Sequence with actions begins its second child, or a later one",
        Severity::Note);
  }

  const Definition& definition_;
  const Reporter& report_;
  std::vector<std::uint32_t> looking_;  // before each node: how many Sequences
};

}  // namespace

void note_unused_holds(const Definition& definition, const Reporter& report) {
  const bool has_any = std::ranges::any_of(
      definition.nodes, [&](const auto& node) { return definition.holds_between(node); });
  if (has_any) BetweenAdviser(definition, report).advise();
}

}  // namespace lockstep::host
