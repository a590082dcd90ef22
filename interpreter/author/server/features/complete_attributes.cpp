#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "author/server/features/completion.h"
#include "describe/node_reference.h"

namespace lockstep::host {
namespace {

class AttributeItems {
 public:
  AttributeItems(const CompletionSite& at, std::vector<CompletionItem>& items)
      : at_(at), items_(items), element_(*at.site.element) {
    for (const TolerantAttribute& it : at.tree.attributes_of(element_)) {
      if (&it != at.site.attribute) present_.insert(it.name);
    }
  }

  void add() {
    const NodeType* const type =
        at_.kind == FileKind::Tree ? type_of(at_.tree, element_, at_.catalog) : nullptr;
    if (type == nullptr) {
      for (const leaf_words::Word& it : words_of(at_.words, element_.tag))
        add(it.name, it.required ? "required" : "optional", it.doc, it.required ? 0 : 1);
      return;
    }
    for (const Parameter& it : type->parameters)
      add(it.name, facts_text(it), it.doc, it.required ? 0 : 1);
    if (type->category == NodeCategory::Group)
      return add("name", "required", "What members call it.", 0);
    if (type->category == NodeCategory::SubTree) add_sub_tree();
    for (const CommonAttribute& it : common_attributes()) add(it.name, "", it.doc, 2);
    if (has_action_attributes(*type)) {
      add(at_.rules.on_resume, "restart, failure or success", action_attributes()[0].doc, 3);
      add(at_.rules.commit, "bool", action_attributes()[1].doc, 3);
    }
    const auto scripts = script_attributes();
    for (std::size_t hook = 0; hook < kHooks; ++hook)
      add(at_.rules.hooks[hook], "script", scripts[hook].doc, 3);
  }

 private:
  void add_sub_tree() {
    add("ID", "required", "The BehaviorTree to insert here.", 0);
    add("_autoremap", "bool", subtree_attributes()[1].doc, 2);
    const TolerantElement* const tree = at_.names.tree_named(at_.tree.value_of(element_, "ID"));
    if (tree == nullptr) return;
    for (const NamePlace& it : at_.names.places()) {
      if (it.kind == NameKind::Entry && it.scope == tree)
        add(it.name, "an entry of the tree", "The entry outside, or a start value.", 1);
    }
  }

  void add(std::string_view name, std::string_view detail, std::string_view doc, int rank) {
    if (name.empty() || !present_.insert(name).second) return;
    CompletionItem item{std::string(name), ItemKind::Property};
    item.detail = detail;
    item.documentation = doc;
    item.rank = rank;
    const auto* const own = at_.site.attribute;
    const bool has_value = own != nullptr && own->has_quote;
    if (!has_value) {
      item.insert = snippet_text(name) + "=\"$1\"";
      item.is_snippet = true;
    }
    items_.push_back(std::move(item));
  }

  const CompletionSite& at_;
  std::vector<CompletionItem>& items_;
  const TolerantElement& element_;
  std::set<std::string_view> present_;
};

}  // namespace

void complete_attributes(const CompletionSite& at, std::vector<CompletionItem>& items) {
  AttributeItems(at, items).add();
}

}  // namespace lockstep::host
