#include "author/server/features/rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "author/edit/renames.h"
#include "author/server/features/names.h"
#include "author/server/features/trial.h"
#include "author/server/features/workspace_edit.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "language/document/byte_order_mark.h"

namespace lockstep::host {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw JsonError(why);
}

// The edits of files, by their URIs. Those of several projects are one where they are the same.
class FileEdits {
 public:
  // Of a text without its byte order mark.
  void add(const std::string& uri, const TextEdit& edit, std::string_view text) {
    texts_.emplace(uri, text);
    for (const Patch& it : edit.patches()) files_[uri].emplace(it.begin, it.end, it.text);
  }
  void add(const Question& question, const ProjectTexts& texts, const ProjectEdit& edit) {
    for (std::uint32_t i = 0; i < texts.size(); ++i) {
      if (edit[i].empty()) continue;
      const Source& source = *texts.document(i).source();
      const auto [uri, open] = changed_file(question, source);
      if (open && without_mark(*open) != source.text())
        refuse(fmt::format("'{}' is being checked: try again", printable(source.path())));
      add(uri, edit[i], source.text());
    }
  }
  Json json(const Question& question) const {
    std::map<std::string, Json> changes;
    for (const auto& [uri, patches] : files_) {
      TextEdit edit;
      for (const auto& [begin, end, text] : patches) edit.replace(begin, end, text);
      const auto file = question.workspace.files().find(uri);
      const bool is_open = file != question.workspace.files().end();
      changes[uri] = json_of_document(edit, is_open ? file->second.bytes() : texts_.at(uri));
    }
    return workspace_edit(question, changes);
  }

 private:
  static std::string_view without_mark(std::string_view text) {
    return text.substr(byte_order_mark(text).size());
  }

  std::map<std::string, std::set<std::tuple<std::size_t, std::size_t, std::string>>> files_;
  std::map<std::string, std::string> texts_;
};

bool is_bound_by_sub_tree(const Names& names, std::string_view key) {
  return std::ranges::any_of(names.texts(), [&](const ProjectText& text) {
    return std::ranges::any_of(text.tree->elements, [&](const TolerantElement& it) {
      return is_sub_tree(it.tag) &&
             std::ranges::count(text.tree->attributes_of(it), key, &TolerantAttribute::name) > 0;
    });
  });
}

// A group has no name that something outside of it could have too.
Json rename_group(const Question& question, const Names& names, const NamePlace& place) {
  const std::string& new_name = question.params.new_name;
  if (!is_identifier(new_name))
    refuse(fmt::format("'{}' cannot be a name here: it is {}", brief(new_name), kIdentifierRule));
  if (place.declared == nullptr) refuse(fmt::format("nothing declares '{}'", brief(place.name)));
  const ProjectText& home = *names.text_of(*place.declared);
  const std::size_t begin = place.declared->begin;
  FileEdits edits;
  for (const Question& it : projects_with(question, home.identity)) {
    const Names all(it);
    const auto same_place = std::ranges::find_if(all.places(), [&](const NamePlace& other) {
      return other.kind == NameKind::Group && other.is_declaration &&
             other.text->identity == home.identity && other.element->begin == begin;
    });
    if (same_place == all.places().end()) continue;
    if (new_name != same_place->name && all.has_group(*same_place->element, new_name))
      refuse(fmt::format("there is a group '{}' already", brief(new_name)));
    if (new_name != same_place->name && is_bound_by_sub_tree(all, new_name))
      refuse(fmt::format("a SubTree has an attribute '{}': its tree would mean that one",
                         brief(new_name)));
    for (const NamePlace* use : all.same_as(*same_place)) {
      const std::size_t mark = byte_order_mark(use->text->tree->text).size();
      TextEdit edit;
      edit.replace(use->range.begin - mark, use->range.end - mark, new_name);
      edits.add(use->text->uri, edit, use->text->tree->text);
    }
  }
  return edits.json(question);
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

// What the place names, in the file that declares it: of an entry, the tree.
struct NamedTree {
  std::string identity, tree;  // its ID there
};

// The edits of one project: of each tree that the text is in it.
void add_renamed(const Question& question, const Names& names, const NamePlace& place,
                 const NamedTree& home, std::string_view new_id, FileEdits& edits) {
  const std::string name = decoded(place.name).text;
  const std::string& new_name = question.params.new_name;
  const auto texts = project_texts(question);
  if (!texts) {
    refuse(fmt::format("'{}' cannot be read: a name can be changed when its errors are mended",
                       printable(question.file.path)));
  }
  // Paths of nodes in properties keep the ID of a tree, and say themselves that they find nothing.
  const bool is_tried = place.kind != NameKind::Tree;
  const auto add = [&](const Result<ProjectEdit>& edit) {
    if (!edit) {
      const Problem& why = edit.error();
      refuse(why.hint.empty() ? why.message : fmt::format("{}: {}", why.message, why.hint));
    }
    if (const auto error = is_tried ? Trial(question, *texts).error_after(*edit) : std::nullopt)
      refuse(fmt::format("the text would have an error: {}", *error));
    edits.add(question, *texts, *edit);
  };
  if (place.kind == NameKind::Argument) return add(rename_argument(*texts, name, new_name));
  if (is_of_main_tree(question, place)) return add(renamed_of_main_tree(*texts, name, new_name));
  const auto text = std::ranges::find(names.texts(), home.identity, &ProjectText::identity);
  for (const std::string& prefix : text->prefixes) {
    if (place.kind == NameKind::Tree) {
      add(rename_tree(*texts, prefix + home.tree, prefix + std::string(new_id)));
    } else {
      add(rename_entry(*texts, prefix + home.tree, name, new_name));
    }
  }
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
  if (place->kind == NameKind::Group) return rename_group(question, names, *place);
  const TolerantElement* const tree =
      place->kind == NameKind::Tree ? place->declared : place->scope;
  FileEdits edits;
  if (tree == nullptr || is_of_main_tree(question, *place)) {
    if (place->kind == NameKind::Tree)
      refuse(fmt::format("there is no tree '{}'", brief(place->name)));
    add_renamed(question, names, *place, {}, {}, edits);
    return edits.json(question);
  }
  const ProjectText& text = *names.text_of(*tree);
  const NamedTree home{text.identity, decoded(text.tree->value_of(*tree, "ID")).text};
  std::string_view new_id = question.params.new_name;
  if (place->kind == NameKind::Tree) {
    const std::string name = decoded(place->name).text;
    if (!name.ends_with(home.tree)) {
      refuse(
          fmt::format("'{}' stands for the main tree of an included file: change 'as' of its "
                      "include, and where that is used",
                      brief(name)));
    }
    const std::string prefix = name.substr(0, name.size() - home.tree.size());
    if (!new_id.starts_with(prefix)) {
      refuse(
          fmt::format("'{}' is in a file that is included as '{}': its new name must begin with "
                      "'{}'",
                      brief(name), brief(prefix.substr(0, prefix.size() - 1)), brief(prefix)));
    }
    new_id.remove_prefix(prefix.size());
  }
  for (const Question& it : projects_with(question, home.identity))
    add_renamed(it, Names(it), *place, home, new_id, edits);
  return edits.json(question);
}

}  // namespace lockstep::host
