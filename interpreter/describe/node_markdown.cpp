#include <fmt/format.h>

#include "core/diagnostics.h"
#include "describe/node_reference.h"

namespace lockstep {
namespace {

// So that what a plugin says of itself stays text.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : printable(text)) {
    if (std::string_view("\\`*_{}[]<>#|&").find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

std::string table_rows(const NodeType& type) {
  std::string text;
  for (const Parameter& it : type.parameters) {
    text += fmt::format("| `{}` | {} | {} |\n", it.name, escaped(facts_text(it)), escaped(it.doc));
  }
  if (type.category != NodeCategory::SubTree) return text;
  for (const CommonAttribute& it : subtree_attributes()) {
    text += fmt::format("| `{}` | | {} |\n", it.name, escaped(it.doc));
  }
  return text;
}

std::string section(const NodeType& type) {
  std::string text = fmt::format("### {}\n\n{}\n\n", type.id, escaped(type.doc));
  std::string children(children_text(type));
  text += fmt::format("`{}`: {}", usage_text(type), children);
  if (!type.plugin.empty()) text += fmt::format("; from the plugin `{}`", type.plugin);
  if (type.category == NodeCategory::Action && !type.has_progress) {
    text += "; it reports no progress: 0 until it succeeds";
  }
  if (type.real_time)
    text += "; it works in real time, so on the virtual clock no tick waits for it";
  text += ".\n\n";
  const std::string table = table_rows(type);
  return table.empty() ? text : text + "| Attribute | Value | |\n|---|---|---|\n" + table + "\n";
}

}  // namespace

std::string nodes_as_markdown(NodeTypes types) {
  std::string text =
      "# Nodes\n\n"
      "Made by `lockstep nodes --format markdown`; do not edit. What the words mean: "
      "[language.md](language.md).\n\n"
      "Every node may have these attributes:\n\n"
      "| Attribute | |\n|---|---|\n";
  for (const CommonAttribute& it : common_attributes()) {
    text += fmt::format("| `{}` | {} |\n", it.name, escaped(it.doc));
  }
  for (const NodeGroup& group : node_groups()) {
    std::string entries;
    for (const NodeType* type : types) {
      if (type->category == group.category) entries += section(*type);
    }
    if (!entries.empty()) text += fmt::format("\n## {}\n\n{}", group.heading, entries);
  }
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace lockstep
