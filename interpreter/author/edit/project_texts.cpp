#include "author/edit/project_texts.h"

#include <algorithm>

#include "author/edit/element_text.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "language/document/references.h"
#include "language/document/value_text.h"
#include "tree/check/node_check.h"

namespace lockstep::host {

ProjectTexts::ProjectTexts(const Project& project, const Catalog& catalog)
    : project_(project), catalog_(catalog), rules_(project.rules) {
  // Its documents have the values of arguments. These had no error that hides elements, so the
  // texts can be read again.
  for (const auto& document : project.documents) {
    const Source& source = *document->source();
    Diagnostics ignored;
    documents_.push_back(Document::parse(source.path(), std::string(source.text()), ignored));
  }
}

ProjectTexts ProjectTexts::with_arguments() const {
  ProjectTexts same = *this;
  for (std::size_t i = 0; i < documents_.size(); ++i)  // they belong to the project
    same.documents_[i] = {std::shared_ptr<void>(), project_.documents[i].get()};
  return same;
}

void ProjectTexts::for_each_element(const std::function<void(ElementAt)>& visit) const {
  for (std::uint32_t i = 0; i < documents_.size(); ++i) {
    if (copies(i).front() != i) continue;
    for (std::uint32_t element = 0; element < documents_[i]->elements().size(); ++element)
      visit({i, element});
  }
}

std::vector<std::uint32_t> ProjectTexts::copies(std::uint32_t index) const {
  const auto file = [&](std::uint32_t i) {
    return file_identity(project_.documents[i]->source()->path());
  };
  if (prefix(index).empty()) return {index};  // each file is included once without a name
  std::vector<std::uint32_t> same;
  for (std::uint32_t i = 0; i < documents_.size(); ++i) {
    if (i == index || file(i) == file(index)) same.push_back(i);
  }
  return same;
}

std::string ProjectTexts::full_id(ElementAt at, std::string_view attribute) const {
  return prefix(at.document) + std::string(value(at, attribute));
}

bool ProjectTexts::is_named_file(std::string_view name) const {
  return std::ranges::any_of(project_.named, [&](const auto& it) { return it.name == name; });
}

std::optional<ElementAt> ProjectTexts::find_tree(std::string_view id) const {
  for (std::uint32_t i = 0; i < documents_.size(); ++i) {
    const auto elements = document(i).elements();
    for (std::uint32_t element = 0; element < elements.size(); ++element) {
      const ElementAt at{i, element};
      if (elements[element].tag == "BehaviorTree" && full_id(at, "ID") == id) return at;
    }
  }
  return std::nullopt;
}

std::optional<ElementAt> ProjectTexts::tree_around(ElementAt at) const {
  const auto elements = document(at.document).elements();
  for (const std::uint32_t child : children_in(elements, 0)) {
    const bool is_inside = child < at.element && at.element < elements[child].end;
    if (is_inside && elements[child].tag == "BehaviorTree") return ElementAt{at.document, child};
  }
  return std::nullopt;
}

std::string_view ProjectTexts::value(ElementAt at, std::string_view name) const {
  const Attribute* it = document(at.document).find_attribute(at.element, name);
  return it == nullptr ? std::string_view() : it->value;
}

std::string ProjectTexts::tree_of(ElementAt sub_tree) const {
  std::string id = full_id(sub_tree, "ID");
  const auto named = std::ranges::find(project_.named, id, &Project::NamedFile::name);
  if (named == project_.named.end()) return id;
  return prefix(named->document) + std::string(main_tree(named->document));
}

std::string_view ProjectTexts::main_tree(std::uint32_t document) const {
  const auto named = value({document, 0}, "main_tree_to_execute");
  if (!named.empty()) return named;
  std::string_view only;
  int trees = 0;
  const auto elements = this->document(document).elements();
  for (const std::uint32_t child : children_in(elements, 0)) {
    if (elements[child].tag != "BehaviorTree") continue;
    only = value({document, child}, "ID");
    ++trees;
  }
  return trees == 1 ? only : std::string_view();
}

bool ProjectTexts::is_sub_tree(ElementAt at) const {
  const std::string_view tag = document(at.document).elements()[at.element].tag;
  return tag == "SubTree" || tag == "SubTreePlus";
}

std::vector<ElementAt> ProjectTexts::modeled_ports(std::string_view tree) const {
  std::vector<ElementAt> ports;
  for (std::uint32_t i = 0; i < documents_.size(); ++i) {
    if (copies(i).front() != i) continue;
    const auto elements = document(i).elements();
    for (const std::uint32_t models : children_in(elements, 0)) {
      if (elements[models].tag != "TreeNodesModel") continue;
      for (const std::uint32_t model : children_in(elements, models)) {
        if (!is_sub_tree({i, model}) || full_id({i, model}, "ID") != tree) continue;
        for (const std::uint32_t port : children_in(elements, model)) ports.push_back({i, port});
      }
    }
  }
  return ports;
}

const NodeType* ProjectTexts::type_of(ElementAt at) const {
  const std::string_view tag = document(at.document).elements()[at.element].tag;
  return catalog_.find(is_explicit_tag(tag) ? value(at, "ID") : tag);
}

bool ProjectTexts::is_in(ElementAt at, std::string_view tag) const {
  const auto elements = document(at.document).elements();
  for (std::uint32_t around = 0; around <= at.element; ++around)
    if (elements[around].tag == tag && at.element < elements[around].end) return true;
  return false;
}

void replace_in_value(TextEdit& edit, const Document& document, const Attribute& attribute,
                      std::size_t begin, std::size_t end, std::string_view text) {
  const std::string_view all = document.source()->text();
  const auto at = attribute_text(document, attribute);
  const std::size_t first = at ? at->value_begin : offset_of(document, attribute.place);
  const std::string_view raw = at ? all.substr(first, at->value_end - first) : all.substr(first);
  edit.replace(first + raw_offset(raw, begin), first + raw_offset(raw, end),
               escaped(text, at ? at->quote_in(all) : '"'));
}

std::vector<std::string_view> keys_in_template(std::string_view value) {
  std::vector<std::string_view> keys;
  for (auto at = value.find('{'); at != value.npos; at = value.find('{', at + 1)) {
    const auto end = value.find('}', at);
    if (end == value.npos) break;
    const bool is_argument = at > 0 && value[at - 1] == '$';
    const std::string_view key = value.substr(at + 1, end - at - 1);
    if (!is_argument && is_identifier(key)) keys.push_back(key);
  }
  return keys;
}

std::optional<std::string_view> key_in_braces(std::string_view value) {
  const bool is_key = value.size() > 2 && value.front() == '{' && value.back() == '}';
  if (!is_key) return std::nullopt;
  const std::string_view key = value.substr(1, value.size() - 2);
  if (key.find_first_of("{}$") != std::string_view::npos) return std::nullopt;
  return key;
}

}  // namespace lockstep::host
