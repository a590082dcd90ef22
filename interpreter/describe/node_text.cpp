#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/utf8.h"
#include "describe/node_reference.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kColumns = 100;

// The words of `text` in lines that begin with `indent` blanks.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines;
  std::size_t column = kColumns;
  while (true) {
    const auto first = text.find_first_not_of(" \n\t");
    if (first == std::string_view::npos) return lines + (lines.empty() ? "" : "\n");
    text.remove_prefix(first);
    const auto word = text.substr(0, std::min(text.find_first_of(" \n\t"), text.size()));
    text.remove_prefix(word.size());
    if (column + 1 + columns(word) > kColumns) {
      if (!lines.empty()) lines += '\n';
      lines.append(indent, ' ');
      column = indent;
    } else {
      lines += ' ';
      ++column;
    }
    const std::string shown = printable(word);
    lines += shown;
    column += columns(shown);
  }
}

struct Row {
  std::string_view name;
  std::string facts;
  std::string_view doc;
};

std::vector<Row> rows(const NodeType& type) {
  std::vector<Row> rows;
  for (const Parameter& parameter : type.parameters) {
    rows.push_back({parameter.name, facts_text(parameter), parameter.doc});
  }
  if (!type.more_parameters.empty()) {
    rows.push_back({type.more_parameters, "", kMoreParameters});
  }
  if (type.category != NodeCategory::SubTree) return rows;
  for (const CommonAttribute& it : subtree_attributes()) rows.push_back({it.name, "", it.doc});
  return rows;
}

std::string table(const std::vector<Row>& rows, std::size_t indent) {
  std::size_t names = 0;
  for (const Row& row : rows) names = std::max(names, columns(row.name));
  std::string text;
  for (const Row& row : rows) {
    const std::size_t docs = indent + names + 2;
    std::string lines = wrapped(row.facts, docs) + wrapped(row.doc, docs);
    if (lines.empty()) lines = std::string(docs, ' ') + "\n";
    lines.replace(indent, row.name.size(), row.name);
    text += lines;
  }
  return text;
}

std::string origin(const NodeType& type) {
  return type.plugin.empty() ? "" : fmt::format(", plugin {}", printable(type.plugin));
}

std::string entry(const NodeType& type) {
  return fmt::format("  {} ({}{})\n", type.id, children_text(type), origin(type)) +
         wrapped(type.doc, 4) + table(rows(type), 6);
}

}  // namespace

std::string nodes_as_text(NodeTypes types) {
  std::string text;
  for (const NodeGroup& group : node_groups()) {
    std::string entries;
    for (const NodeType* type : types) {
      if (type->category == group.category) entries += entry(*type) + "\n";
    }
    if (!entries.empty()) text += fmt::format("{}\n\n{}", group.heading, entries);
  }
  std::vector<Row> common;
  for (const CommonAttribute& it : common_attributes()) common.push_back({it.name, "", it.doc});
  for (const CommonAttribute& it : script_attributes()) common.push_back({it.name, "", it.doc});
  std::vector<Row> of_actions;
  for (const CommonAttribute& it : action_attributes()) of_actions.push_back({it.name, "", it.doc});
  return text + "Attributes of every node\n\n" + table(common, 2) +
         "\nAttributes of actions of plugins\n\n" + table(of_actions, 2);
}

std::string node_as_text(const NodeType& type) {
  std::string text = fmt::format("{}: {}, {}{}\n\n", type.id, to_string(type.category),
                                 children_text(type), origin(type));
  text += wrapped(type.doc, 2) + "\n  " + usage_text(type) + "\n";
  if (type.category == NodeCategory::Action && !type.has_progress) {
    text += "\n  It reports no progress: 0 until it succeeds.\n";
  }
  if (type.real_time) {
    text += "\n  It works in real time: on the virtual clock no tick waits for it.\n";
  }
  const std::string behavior = behavior_text(type);
  if (!behavior.empty())
    text += "\n" + wrapped("As its plugin declares, for verify: " + behavior, 2);
  const auto parameters = rows(type);
  return parameters.empty() ? text : text + "\n" + table(parameters, 2);
}

}  // namespace lockstep::host
