#include "tree/check/node_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr NodeCategory kExplicit[] = {NodeCategory::Action, NodeCategory::Condition,
                                      NodeCategory::Control, NodeCategory::Decorator};

}  // namespace

std::string_view explicit_tag(NodeCategory category) {
  switch (category) {
    case NodeCategory::Action:
      return "Action";
    case NodeCategory::Condition:
      return "Condition";
    case NodeCategory::Control:
      return "Control";
    case NodeCategory::Decorator:
      return "Decorator";
    default:
      return "";
  }
}

bool is_explicit_tag(std::string_view tag) {
  return std::ranges::find(kExplicit, tag, explicit_tag) != std::end(kExplicit);
}

void check_arity(ElementOf element, const CheckedNode& node, const Reporter& report) {
  const NodeType& type = *node.type;
  if (type.category == NodeCategory::SubTree) {
    if (node.children == 0) return;
    report.at("child-count"_code, element.all[element.index + 1].place,
              "'SubTree' cannot have children", "its tree is the BehaviorTree that its ID names");
  } else if (node.children < type.arity.min) {
    const bool any_number = type.arity.min == 1 && type.arity.max > 1;
    report.at(
        "child-count"_code, node.place,
        fmt::format("'{}' needs {}", type.id,
                    any_number ? "a child" : arity_text(type.arity.min, type.arity.max)),
        node.children == 0
            ? fmt::format("it is a {}: put {} into it", to_string(type.category),
                          type.arity.min == 1 ? "a node" : "nodes")
            : fmt::format("it has {}; `lockstep nodes {}` describes them", node.children, type.id));
  } else if (node.children > type.arity.max) {
    // The first child that is one too many.
    std::uint32_t extra = element.index + 1;
    for (std::uint32_t i = 0; i < type.arity.max; ++i) extra = element.all[extra].end;
    report.at("child-count"_code, element.all[extra].place,
              type.arity.max == 0 ? fmt::format("'{}' cannot have children", type.id)
              : type.arity.max == 1
                  ? fmt::format("'{}' has more than one child", type.id)
                  : fmt::format("'{}' has more than {} children", type.id, type.arity.max),
              type.arity.max == 0 ? fmt::format("it is a leaf ({})", to_string(type.category))
                                  : "put the children into a Sequence, a Fallback or a "
                                    "parallel node");
  }
}

}  // namespace lockstep::host
