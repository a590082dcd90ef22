#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "tree/advise/advise.h"

namespace lockstep::host {
namespace {

// A leaf that works in real time and has the constant 'hold' leaves it to the tree what a robot
// does while the leaf is held.
class HoldAdviser {
 public:
  HoldAdviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() const {
    for (const DefinitionNode& node : definition_.nodes) {
      if (!has_choice(*node.type)) continue;
      if (const auto holder = holder_of(node)) tell(node, *holder);
    }
  }

 private:
  static bool has_choice(const NodeType& type) {
    return type.real_time && std::ranges::any_of(type.parameters, [](const Parameter& it) {
             return it.name == "hold" && it.constant;
           });
  }

  // The node that may hold it; nothing: none does.
  std::optional<std::uint32_t> holder_of(const DefinitionNode& leaf) const {
    for (auto node = static_cast<std::uint32_t>(&leaf - definition_.nodes.data()); node > 0;) {
      const auto declared = std::ranges::find_if(definition_.groups, [&](const auto& group) {
        return std::ranges::find(group.members, node) != group.members.end();
      });
      if (declared != definition_.groups.end()) return declared->node;
      node = definition_.nodes[node].parent;
      if (compares_progress(definition_.nodes[node].type->synchronization)) return node;
    }
    return std::nullopt;
  }

  void tell(const DefinitionNode& leaf, std::uint32_t holder) const {
    const std::string_view by = definition_.nodes[holder].name;
    const Value* const hold = definition_.constant(leaf, "hold");
    if (hold == nullptr) {
      report_.at(
          "unstated-hold"_code, leaf.place,
          fmt::format("'{}' may be held by '{}', and does not declare what the robot does then",
                      leaf.name, by),
          fmt::format("give hold; `lockstep nodes {}` has the ways", leaf.type->id),
          Severity::Warning);
    } else if (*hold == Value("nothing")) {
      report_.at("moves-while-paused"_code, leaf.place,
                 fmt::format("while '{}' holds '{}', the robot continues: hold=\"nothing\"", by,
                             leaf.name),
                 {}, Severity::Note);
    }
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void advise_holds(const Definition& definition, const Reporter& report) {
  HoldAdviser(definition, report).advise();
}

}  // namespace lockstep::host
