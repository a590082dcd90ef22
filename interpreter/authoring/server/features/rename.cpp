#include "authoring/server/features/rename.h"

#include <fmt/format.h>

#include <algorithm>

#include "authoring/server/features/names.h"
#include "authoring/server/features/workspace_edit.h"
#include "core/identifier.h"
#include "core/wording.h"

namespace lockstep::host {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw JsonError(why);
}

// What the language takes as such a name, and does not mix up with another one.
void check_new_name(const Names& names, const NamePlace& place, std::string_view name) {
  const bool is_plain = !name.empty() && name.find_first_of(" \t\r\n\"'<>&{}$/;,=") == name.npos;
  const bool is_entry = place.kind == NameKind::Entry;
  if (!is_plain || (is_entry && !is_identifier(name)))
    refuse(fmt::format("'{}' cannot be a name here", brief(name)));
  NamePlace other = place;
  other.name = name;
  if (name != place.name && !names.same_as(other).empty())
    refuse(fmt::format("the name '{}' is taken", brief(name)));
}

// With _autoremap, an entry has its name in two trees.
void check_scope(const Names& names, const NamePlace& place) {
  if (place.kind != NameKind::Entry) return;
  for (const ProjectText& text : names.texts()) {
    for (const TolerantElement& it : text.tree->elements) {
      if (!is_sub_tree(it.tag)) continue;
      const bool is_near = tree_around(*text.tree, it) == place.scope ||
                           names.tree_named(text.tree->value_of(it, "ID")) == place.scope;
      for (const TolerantAttribute& attribute : text.tree->attributes_of(it)) {
        if (is_near && attribute.name.ends_with("_autoremap") && attribute.value != "false")
          refuse("a SubTree with _autoremap has entries of the same name inside and outside");
      }
    }
  }
}

}  // namespace

Json prepare_rename(const Question& question) {
  const Names names(question);
  const NamePlace* const place = names.at(question.byte());
  if (place == nullptr) return {};
  return {{"range", question.file.positions().json(place->range)},
          {"placeholder", std::string(place->name)}};
}

Json rename(const Question& question) {
  const Names names(question);
  const NamePlace* const place = names.at(question.byte());
  const std::string& name = question.params.new_name;
  if (place == nullptr) refuse("nothing here has a name that can be changed");
  check_new_name(names, *place, name);
  check_scope(names, *place);
  std::map<const ProjectText*, TextEdit> edits;
  for (const NamePlace* it : names.same_as(*place))
    edits[it->text].replace(it->range.begin, it->range.end, name);
  std::map<std::string, Json> changes;
  for (const auto& [text, edit] : edits)
    changes[text->uri] = json_of(edit, Positions(text->tree->text));
  return workspace_edit(changes);
}

}  // namespace lockstep::host
