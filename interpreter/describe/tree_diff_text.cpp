#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/terminal/style.h"
#include "describe/tree_diff.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostPaths = 3;

Style style_of(TreeChangeKind kind) {
  constexpr Style kStyles[] = {Style::Warning, Style::Warning, Style::Active, Style::Good,
                               Style::Bad};
  return kStyles[static_cast<unsigned>(kind)];
}

Style style_of(char sign) {
  switch (sign) {
    case '+':
      return Style::Good;
    case '-':
      return Style::Bad;
    case '~':
      return Style::Warning;
    case ' ':
      return Style::Plain;
    default:
      return Style::Active;
  }
}

std::string place_text(const SourceLocation& place) {
  return fmt::format("{}:{}", printable(place.file), place.line);
}

std::string places_text(const SourceLocation& old_place, const SourceLocation& new_place) {
  if (old_place.line == 0) return place_text(new_place);
  if (new_place.line == 0) return place_text(old_place);
  return old_place.file == new_place.file && old_place.line == new_place.line
             ? place_text(new_place)
             : place_text(old_place) + " → " + place_text(new_place);
}

std::string last_part(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string details(const TreeDiff& diff, const TreeChange& change) {
  const auto& [a, b] = diff.trees;
  switch (change.kind) {
    case TreeChangeKind::Changed:
      return text_of(change.values);
    case TreeChangeKind::Renamed:
      return fmt::format("{} → {}", printable(a.node(change.old_node).name),
                         printable(b.node(change.new_node).name));
    case TreeChangeKind::Moved:
      return change.old_child != 0
                 ? fmt::format("child {} → {} of {}", change.old_child, change.new_child,
                               printable(last_part(b.paths[b.node(change.new_node).parent])))
                 : fmt::format("from {}", printable(a.paths[change.old_node]));
    case TreeChangeKind::New:
    case TreeChangeKind::Gone:
      break;
  }
  const bool is_new = change.kind == TreeChangeKind::New;
  const MatchedTree& tree = is_new ? b : a;
  std::string text =
      text_of_node(tree.definition, tree.node(is_new ? change.new_node : change.old_node));
  if (change.around != kNoNode) {
    text += fmt::format(" around {}", printable(a.paths[change.around]));
  }
  if (change.below > 0) text += fmt::format(", {} below it", counted(change.below, "node"));
  return text;
}

std::string also_text(const TreeChange& change) {
  if (change.also.empty()) return {};
  const auto text_of = [](const std::string& path) { return printable(path); };
  return fmt::format("         also {}\n", some_of(change.also, kMostPaths, text_of));
}

std::string summary(const TreeDiff& diff) {
  std::vector<std::string> parts;
  if (diff.is_tree_renamed()) parts.emplace_back("the tree renamed");
  for (unsigned kind = 0; kind < 5; ++kind) {
    const auto count =
        std::ranges::count(diff.changes, static_cast<TreeChangeKind>(kind), &TreeChange::kind);
    if (count > 0) {
      parts.push_back(fmt::format("{} {}", count, to_string(static_cast<TreeChangeKind>(kind))));
    }
  }
  if (!diff.properties.empty()) {
    const std::size_t count = diff.properties.size();
    parts.push_back(fmt::format("{} {}", count, count == 1 ? "property" : "properties"));
  }
  return joined(parts, ", ");
}

std::string property_text(const PropertyChange& it) {
  const std::string name = it.name.empty() ? "property" : "property " + printable(it.name);
  if (it.old_text.empty()) return fmt::format("{}  {}", name, printable(it.new_text));
  if (it.new_text.empty()) return fmt::format("{}  {}", name, printable(it.old_text));
  return fmt::format("{}  {} → {}", name, printable(it.old_text), printable(it.new_text));
}

}  // namespace

std::string diff_as_text(const TreeDiff& diff, bool color) {
  std::string text;
  const auto line = [&](TreeChangeKind kind, const std::string& what, const std::string& where) {
    text += styled(fmt::format("{:<8}", to_string(kind)), style_of(kind), color);
    text += fmt::format(" {}  {}\n", what, styled(where, Style::Dim, color));
  };
  if (diff.is_tree_renamed()) {
    line(TreeChangeKind::Renamed,
         fmt::format("the tree  {} → {}", printable(diff.sides[0].definition->id),
                     printable(diff.sides[1].definition->id)),
         printable(diff.sides[1].name));
  }
  for (const TreeChange& it : diff.changes) {
    line(it.kind, fmt::format("{}  {}", printable(diff.path(it)), details(diff, it)),
         places_text(it.old_place, it.new_place));
    text += also_text(it);
  }
  for (const PropertyChange& it : diff.properties) {
    line(it.old_text.empty()   ? TreeChangeKind::New
         : it.new_text.empty() ? TreeChangeKind::Gone
                               : TreeChangeKind::Changed,
         property_text(it), places_text(it.old_place, it.new_place));
  }
  if (!text.empty()) text += summary(diff) + '\n';
  return text;
}

std::string diff_as_tree(const TreeDiff& diff, bool ascii, bool color) {
  std::string text = printable(diff.sides[1].definition->id) + '\n';
  std::vector<std::string> before{""};  // by depth: what is before the rows there
  for (const DiffRow& row : rows_of(diff)) {
    before.resize(row.depth + 1);
    const std::string_view branch =
        ascii ? (row.is_last ? "`-- " : "|-- ") : (row.is_last ? "└── " : "├── ");
    const std::string line =
        fmt::format("{} {}{}{}", row.sign, before[row.depth], branch, text_of(diff, row));
    text += styled(line, style_of(row.sign), color) + '\n';
    before.push_back(before[row.depth] + (row.is_last ? "    " : (ascii ? "|   " : "│   ")));
  }
  return text;
}

}  // namespace lockstep::host
