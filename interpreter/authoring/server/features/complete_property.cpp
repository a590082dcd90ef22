#include <algorithm>
#include <cctype>
#include <set>

#include "authoring/server/features/completion.h"
#include "property/property_words.h"

namespace lockstep::host {
namespace {

bool is_of_path(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// As properties call them, each once.
std::set<std::string_view> node_names(const CompletionSite& at) {
  std::set<std::string_view> names;
  for (const ProjectText& text : at.names.texts()) {
    for (const TolerantElement& it : text.tree->elements) {
      if (it.tag.empty() || tree_around(*text.tree, it) == nullptr) continue;
      const std::string_view name = text.tree->value_of(it, "name");
      names.insert(name.empty() ? it.tag : name);
    }
  }
  return names;
}

}  // namespace

void complete_property(const CompletionSite& at, std::vector<CompletionItem>& items,
                       ByteRange& replaced) {
  const std::string_view text = at.tree.text;
  std::size_t begin = at.byte;
  while (begin > at.site.element->tag_end && is_of_path(text[begin - 1])) --begin;
  replaced = {begin, at.byte};
  if (begin > 0 && text[begin - 1] == '.') {
    for (const std::string_view it : kPropertyFields)
      items.push_back({std::string(it), ItemKind::Property});
    return;
  }
  for (const std::string_view it : node_names(at))
    items.push_back({std::string(it), ItemKind::Module, "node"});
  for (const std::string_view it : kPropertyWords)
    items.push_back({std::string(it), ItemKind::Keyword});
}

}  // namespace lockstep::host
