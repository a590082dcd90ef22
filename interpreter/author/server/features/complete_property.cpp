#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "author/server/features/completion.h"
#include "language/property/property_token.h"
#include "language/property/property_words.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

bool is_of_path(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/' || c == '-' ||
         c == '#' || static_cast<unsigned char>(c) >= 0x80;
}

// As the path of a node has it.
std::string_view name_of(const TolerantTree& tree, const TolerantElement& element) {
  const std::string_view name = tree.value_of(element, "name");
  if (!name.empty()) return name;
  const std::string_view id =
      is_sub_tree(element.tag) || is_explicit_tag(element.tag) ? tree.value_of(element, "ID") : "";
  return id.empty() ? element.tag : id;
}

// Each once.
std::set<std::string_view> node_names(const CompletionSite& at) {
  std::set<std::string_view> names;
  for (const ProjectText& text : at.names.texts()) {
    for (const TolerantElement& it : text.tree->elements) {
      if (it.tag.empty() || tree_around(*text.tree, it) == nullptr) continue;
      names.insert(name_of(*text.tree, it));
    }
  }
  return names;
}

// Whether a property reads it as a name without quotes.
bool is_plain(const std::string& name) {
  std::size_t offset = 0;
  const auto token = next_property_token(name, offset);
  return token && token->kind == PropertyToken::Kind::Word && offset == name.size() &&
         std::ranges::count(kPropertyWords, name) == 0;
}

// In quotes where it needs them; "": no quotes can hold it.
std::string as_written(std::string_view name) {
  const std::string read = decoded(name).text;
  if (is_plain(read)) return std::string(name);
  for (const char quote : {'\'', '"'})
    if (read.find(quote) == read.npos) return fmt::format("{0}{1}{0}", quote, name);
  return {};
}

// Where the quote is that is open at the end; nothing: none is.
std::optional<std::size_t> open_quote(std::string_view text) {
  std::optional<std::size_t> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_quote = text[i] == '\'' || text[i] == '"';
    if (open && text[i] == text[*open]) {
      open.reset();
    } else if (!open && is_quote) {
      open = i;
    }
  }
  return open;
}

}  // namespace

void complete_property(const CompletionSite& at, std::vector<CompletionItem>& items,
                       ByteRange& replaced) {
  const std::string_view text = at.tree.text;
  const std::size_t first = at.site.element->tag_end;
  const auto quote = open_quote(text.substr(first, at.byte - first));
  std::size_t begin = at.byte;
  while (begin > first && is_of_path(text[begin - 1])) --begin;
  if (quote) begin = first + *quote;
  replaced = {begin, at.byte};
  if (!quote && begin > 0 && text[begin - 1] == '.') {
    for (const std::string_view it : kPropertyFields)
      items.push_back({std::string(it), ItemKind::Property});
    return;
  }
  for (const std::string_view it : node_names(at)) {
    const std::string name = as_written(it);
    if (!name.empty()) items.push_back({name, ItemKind::Module, "node"});
  }
  for (const std::string_view it : kPropertyWords)
    items.push_back({std::string(it), ItemKind::Keyword});
}

}  // namespace lockstep::host
