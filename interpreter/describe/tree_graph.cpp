// A tree as text for programs that draw graphs. Both languages read characters of a label as
// markup: all that are not letters, digits or harmless are written as what they are.
#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "describe/tree_drawing.h"

namespace lockstep::host {
namespace {

std::string dot_escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '"':
        safe += "\\\"";
        break;
      case '\\':
        safe += "\\\\";
        break;
      case '&':
        safe += "&amp;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string mermaid_escaped(std::string_view text) {
  constexpr std::string_view kMarkup = "\"#&<>;`\\[](){}|*_~$%@:";
  std::string safe;
  for (const char c : text) {
    safe += kMarkup.find(c) == std::string_view::npos ? std::string(1, c)
                                                      : fmt::format("#{};", static_cast<int>(c));
  }
  return safe;
}

std::string label(const Definition& definition, const DefinitionNode& node,
                  std::string (*escape)(std::string_view), std::string_view line_break) {
  std::string text;
  for (const std::string& line : shown_lines(definition, node)) {
    if (!text.empty()) text += line_break;
    text += escape(line);
  }
  return text;
}

std::string_view dot_shape(NodeCategory category) {
  constexpr std::string_view kShapes[] = {"square", "diamond", "box", "ellipse", "tab", "hexagon"};
  return kShapes[static_cast<unsigned>(category)];
}

struct Brackets {
  std::string_view open, close;
};

Brackets mermaid_shape(NodeCategory category) {
  constexpr Brackets kShapes[] = {{"[", "]"},   {"{{", "}}"}, {"[", "]"},
                                  {"([", "])"}, {"[[", "]]"}, {"{{", "}}"}};
  return kShapes[static_cast<unsigned>(category)];
}

template <class Visit>
void for_each_member(const Definition& definition, Visit visit) {
  for (const DefinitionGroup& group : definition.groups) {
    for (const std::uint32_t member : group.members) visit(group.node, member);
  }
}

}  // namespace

std::string tree_as_dot(const Definition& definition) {
  std::string text = fmt::format(
      "digraph \"{}\" {{\n  node [fontname=\"sans-serif\"];\n  edge [arrowhead=none];\n"
      "  ordering=out;\n",
      dot_escaped(printable(definition.id)));
  const auto& nodes = definition.nodes;
  for (std::uint32_t index = 0; index < nodes.size(); ++index) {
    text += fmt::format("  n{} [shape={}, label=\"{}\"];\n", index,
                        dot_shape(nodes[index].type->category),
                        label(definition, nodes[index], dot_escaped, "\\n"));
    if (nodes[index].parent != index) {
      text += fmt::format("  n{} -> n{};\n", nodes[index].parent, index);
    }
  }
  for_each_member(definition, [&](std::uint32_t group, std::uint32_t member) {
    text += fmt::format("  n{} -> n{} [style=dashed, constraint=false];\n", group, member);
  });
  return text + "}\n";
}

std::string tree_as_mermaid(const Definition& definition) {
  std::string text = "flowchart TD\n";
  const auto& nodes = definition.nodes;
  for (std::uint32_t index = 0; index < nodes.size(); ++index) {
    const auto [open, close] = mermaid_shape(nodes[index].type->category);
    text += fmt::format("  n{}{}\"{}\"{}\n", index, open,
                        label(definition, nodes[index], mermaid_escaped, "<br/>"), close);
    if (nodes[index].parent != index) {
      text += fmt::format("  n{} --- n{}\n", nodes[index].parent, index);
    }
  }
  for_each_member(definition, [&](std::uint32_t group, std::uint32_t member) {
    text += fmt::format("  n{} -.- n{}\n", group, member);
  });
  return text;
}

}  // namespace lockstep::host
