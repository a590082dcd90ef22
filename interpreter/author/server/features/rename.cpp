#include "author/server/features/rename.h"

#include <fmt/format.h>

#include <algorithm>

#include "author/edit/renames.h"
#include "author/server/features/names.h"
#include "author/server/features/trial.h"
#include "author/server/features/workspace_edit.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw JsonError(why);
}

// The ID of a BehaviorTree.
std::string id_of(const Names& names, const TolerantElement& tree) {
  for (const ProjectText& text : names.texts()) {
    const auto& elements = text.tree->elements;
    if (!elements.empty() && &tree >= &elements.front() && &tree <= &elements.back())
      return decoded(text.tree->value_of(tree, "ID")).text;
  }
  return {};
}

// A group has no name that something outside of it could have too.
std::map<std::string, Json> rename_group(const Names& names, const NamePlace& place,
                                         const std::string& new_name) {
  NamePlace other = place;
  other.name = new_name;
  if (new_name.empty() || new_name.find_first_of(" \t\r\n\"'<>&{}$/;,=") != new_name.npos)
    refuse(fmt::format("'{}' cannot be a name here", brief(new_name)));
  if (new_name != place.name && !names.same_as(other).empty())
    refuse(fmt::format("there is a group '{}' already", brief(new_name)));
  std::map<const ProjectText*, TextEdit> edits;
  for (const NamePlace* it : names.same_as(place))
    edits[it->text].replace(it->range.begin, it->range.end, new_name);
  std::map<std::string, Json> changes;
  for (const auto& [text, edit] : edits) changes[text->uri] = json_of(edit, text->positions);
  return changes;
}

// Whether it is "@key", an entry of the main tree.
bool is_of_main_tree(const Question& question, const NamePlace& place) {
  return place.kind == NameKind::Entry && rules_of(question).marked_keys && place.name.size() > 1 &&
         place.name.front() == '@';
}

Result<ProjectEdit> renamed_of_main_tree(const ProjectTexts& texts, std::string_view marked,
                                         std::string_view new_name) {
  if (texts.main_tree().empty()) {
    return problem(fmt::format("'{}' is an entry of the main tree", brief(marked)),
                   "this file does not name its main tree: main_tree_to_execute");
  }
  if (new_name.starts_with('@')) new_name.remove_prefix(1);
  return rename_entry(texts, texts.main_tree(), marked.substr(1), new_name);
}

Result<ProjectEdit> renamed(const Question& question, const ProjectTexts& texts, const Names& names,
                            const NamePlace& place) {
  const std::string& new_name = question.params.new_name;
  const std::string name = decoded(place.name).text;
  if (place.kind == NameKind::Tree) return rename_tree(texts, name, new_name);
  if (place.kind == NameKind::Argument) return rename_argument(texts, name, new_name);
  if (is_of_main_tree(question, place)) return renamed_of_main_tree(texts, name, new_name);
  return rename_entry(texts, id_of(names, *place.scope), name, new_name);
}

}  // namespace

Json prepare_rename(const Question& question) {
  const Names names(question);
  const NamePlace* const place = names.at(question.byte());
  if (place == nullptr) return {};
  const std::size_t mark = is_of_main_tree(question, *place) ? 1 : 0;
  const ByteRange range{place->range.begin + mark, place->range.end};
  return {{"range", question.file.positions().json(range)},
          {"placeholder", std::string(place->name.substr(mark))}};
}

Json rename(const Question& question) {
  const Names names(question);
  const NamePlace* const place = names.at(question.byte());
  if (place == nullptr) refuse("nothing here has a name that can be changed");
  const std::string& new_name = question.params.new_name;
  if (place->kind == NameKind::Group)
    return workspace_edit(question, rename_group(names, *place, new_name));
  const auto texts = project_texts(question);
  if (!texts) refuse("the file cannot be read: a name can be changed when its errors are mended");
  const auto edits = renamed(question, *texts, names, *place);
  if (!edits) {
    const Problem& why = edits.error();
    refuse(why.hint.empty() ? why.message : fmt::format("{}: {}", why.message, why.hint));
  }
  // Paths of nodes in properties keep the ID of a tree, and say themselves that they find nothing.
  const bool is_tried = place->kind != NameKind::Tree;
  if (const auto error = is_tried ? Trial(question, *texts).error_after(*edits) : std::nullopt)
    refuse(fmt::format("the text would have an error: {}", *error));
  return workspace_edit(question, *texts, *edits);
}

}  // namespace lockstep::host
