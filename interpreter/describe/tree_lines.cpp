#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "describe/tree_drawing.h"

namespace lockstep::host {
namespace {

struct Strokes {
  std::string_view branch, last, pass, blank;
};
constexpr Strokes kBoxes{"├── ", "└── ", "│   ", "    "};
constexpr Strokes kAscii{"|-- ", "`-- ", "|   ", "    "};

std::string line(const Definition& definition, const DefinitionNode& node) {
  std::string text(node.type->id);
  if (node.name != node.type->id) text += fmt::format(" '{}'", printable(node.name));
  for (const std::string& attribute : shown_attributes(definition, node)) text += " " + attribute;
  return text;
}

}  // namespace

std::string tree_as_text(const Definition& definition, bool ascii) {
  const Strokes& strokes = ascii ? kAscii : kBoxes;
  const auto& nodes = definition.nodes;
  std::string text = printable(definition.id) + "\n";
  // The text before the children of each node, which come after it.
  std::vector<std::string> before(nodes.size());
  for (std::uint32_t index = 0; index < nodes.size(); ++index) {
    const DefinitionNode& node = nodes[index];
    const bool is_top = node.parent == index;  // the root, and the groups behind it
    const std::string prefix = is_top ? "" : before[node.parent];
    const bool last = is_top ? node.end == nodes.size() : node.end == nodes[node.parent].end;
    text.append(prefix).append(last ? strokes.last : strokes.branch);
    text.append(line(definition, node)).append("\n");
    if (node.children > 0)
      before[index] = prefix + std::string(last ? strokes.blank : strokes.pass);
  }
  return text;
}

}  // namespace lockstep::host
