#include "author/scaffold/plugin_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "author/scaffold/code_mask.h"
#include "author/scaffold/source_places.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// Insertions into a text at places of what it was.
class Insertions {
 public:
  void add(std::size_t at, std::string text) { all_.emplace_back(at, std::move(text)); }
  std::string apply(std::string text) {
    std::ranges::stable_sort(all_, {}, &std::pair<std::size_t, std::string>::first);
    const std::string line_end = text.find("\r\n") == kNowhere ? "\n" : "\r\n";
    for (auto it = all_.rbegin(); it != all_.rend(); ++it) {
      text.insert(it->first, std::regex_replace(it->second, std::regex("\n"), line_end));
    }
    return text;
  }

 private:
  std::vector<std::pair<std::size_t, std::string>> all_;
};

// Behind the last item of a list, and behind a comment on its line.
void add_item(const std::string& mask, const ItemList& list, const std::string& item,
              Insertions& to) {
  const auto last = mask.find_last_not_of(kBlanks, list.close - 1);
  const bool is_empty = last <= list.open, ends_with_comma = mask[last] == ',';
  const auto line_end = mask.find('\n', last);
  const bool stays_on_line = list.may_stay_on_line && mask.find('\n', list.open) >= list.close;
  const auto at =
      line_end < list.close ? line_end - (mask[line_end - 1] == '\r' ? 1 : 0) : last + 1;
  const std::string before = stays_on_line ? (is_empty ? "" : " ") : '\n' + list.indentation;
  if (!is_empty && !ends_with_comma) to.add(last + 1, ",");
  to.add(at, before + item + (ends_with_comma ? "," : ""));
}

// The names that the node needs and a source in Python does not import: into its list of them, or,
// where it has none, as a line of text, which is returned.
std::string import_names(const std::string& mask, const NewNode& node, Insertions& to) {
  const ItemList list = import_list(mask);
  const bool has_list = list.open != kNowhere;
  const std::string known = has_list ? mask.substr(list.open, list.close - list.open) : "";
  std::vector<std::string> missing;
  for (const std::string& name : names_used(node)) {
    const bool is_known =
        known.find('*') != kNowhere || std::regex_search(known, std::regex("\\b" + name + "\\b"));
    if (!is_known && std::ranges::find(missing, name) == missing.end()) missing.push_back(name);
  }
  const std::string names = joined(missing, ", ");
  if (names.empty()) return {};
  if (has_list) {
    add_item(mask, list, names, to);
    return {};
  }
  return fmt::format("from lockstep_leaf import {}\n\n\n", names);
}

bool has_node(const PluginSource& source, const std::string& mask, const NewNode& node) {
  const std::regex is_class("\\b(class|struct)\\s{1,99}" + node.id + "\\b");
  const bool is_named =
      !is_python(*source.language) && source.text.find('"' + node.id + '"') != kNowhere;
  return is_named || std::regex_search(mask, is_class);
}

}  // namespace

Result<NodeText> text_for(const PluginSource& source, const NewNode& node) {
  if (has_node(source, code_mask(*source.language, source.text), node)) {
    return problem(fmt::format("'{}' has a '{}' already", source.path.string(), node.id),
                   "take another name");
  }
  return node_text(*source.language, node);
}

Result<std::string> insert_node(const PluginSource& source, const NewNode& node) {
  const auto text = text_for(source, node);
  if (!text) return tl::unexpected(text.error());
  const std::string mask = code_mask(*source.language, source.text);
  const SourcePlaces places = source_places(source, mask);
  if (!places.are_complete) {
    return problem(
        fmt::format("'{}' has no place for a node: {}", source.path.string(), places.missing),
        "--print prints the node, for you to paste");
  }
  Insertions insertions;
  if (is_python(*source.language)) {
    const std::string import = import_names(mask, node, insertions);
    insertions.add(places.definition, import + text->definition + "\n\n");
  } else {
    insertions.add(places.definition, text->definition + "\n");
    add_item(mask, places.nodes, text->entry, insertions);
  }
  return insertions.apply(source.text);
}

}  // namespace lockstep::host
