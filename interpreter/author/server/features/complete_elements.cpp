#include <fmt/format.h>

#include "author/server/features/completion.h"
#include "describe/node_reference.h"

namespace lockstep::host {
namespace {

class ElementItems {
 public:
  ElementItems(const CompletionSite& at, std::vector<CompletionItem>& items)
      : at_(at),
        items_(items),
        is_new_(at.site.part == Site::Part::Content),
        around_(is_new_ ? at.site.element : at.tree.parent_of(*at.site.element)) {}

  void add() {
    if (around_ == nullptr) return add_word({at_.words.root, at_.words.root_words, ""}, 0);
    if (at_.kind == FileKind::Scenarios) return add_scenario_words();
    if (around_->tag == "scenario") {
      for (const leaf_words::Tag& it : vocabulary_of(FileKind::Scenarios).tags) {
        if (it.name != "scenario") add_word(it, 0);
      }
      return;
    }
    if (around_->tag == at_.words.root) {
      for (const leaf_words::Tag& it : at_.words.tags) add_word(it, 0);
      if (at_.kind == FileKind::Tree) add_nodes(true);
    } else if (at_.kind == FileKind::Tree && may_have_nodes()) {
      add_nodes(false);
    }
  }

 private:
  void add_scenario_words() {
    const bool is_in_file = around_->tag == at_.words.root;
    for (const leaf_words::Tag& it : at_.words.tags) {
      if (is_in_file || (around_->tag == "scenario" && it.name != "scenario")) add_word(it, 0);
    }
  }

  bool may_have_nodes() const {
    if (around_->tag == "BehaviorTree") return true;
    if (tag_named(at_.words, around_->tag) != nullptr) return false;
    const NodeType* const type = type_of(at_.tree, *around_, at_.catalog);
    return type == nullptr || (type->arity.max > 0 && type->category != NodeCategory::SubTree &&
                               type->category != NodeCategory::Group);
  }

  void add_nodes(bool are_groups) {
    for (const NodeType* type : at_.catalog.types()) {
      if ((type->category == NodeCategory::Group) != are_groups) continue;
      CompletionItem item{std::string(type->id), ItemKind::Class};
      item.detail = to_string(type->category);
      if (!type->plugin.empty()) item.detail += fmt::format(", plugin {}", type->plugin);
      if (type->category == NodeCategory::Action) item.kind = ItemKind::Function;
      if (type->category == NodeCategory::Condition) item.kind = ItemKind::Event;
      item.documentation = fmt::format("```text\n{}```", node_as_text(*type));
      item.rank = type->plugin.empty() ? 1 : 0;
      set_text(item, node_snippet(*type));
    }
  }

  void add_word(const leaf_words::Tag& word, int rank) {
    CompletionItem item{std::string(word.name), ItemKind::Struct};
    item.documentation = word.doc;
    item.rank = rank;
    std::string snippet(word.name);
    int stop = 0;
    for (const leaf_words::Word& it : word.words) {
      if (!it.required) continue;
      const bool is_version = it.name == "lockstep";
      snippet += is_version ? fmt::format(" {}=\"{}\"", it.name, it.pattern)
                            : fmt::format(" {}=\"${}\"", it.name, ++stop);
    }
    const bool has_content =
        word.name == at_.words.root || word.name == "BehaviorTree" || word.name == "scenario";
    if (has_content) {
      snippet += fmt::format(">\n  $0\n</{}>", word.name);
    } else if (word.name == "property") {
      snippet += ">$0</property>";
    } else {
      snippet += "/>$0";
    }
    set_text(item, std::move(snippet));
  }

  std::string node_snippet(const NodeType& type) const {
    std::string text(type.id);
    int stop = 0;
    if (type.category == NodeCategory::SubTree) text += fmt::format(" ID=\"${}\"", ++stop);
    if (type.category == NodeCategory::Group) text += fmt::format(" name=\"${}\"", ++stop);
    for (const Parameter& it : type.parameters) {
      if (!it.required) continue;
      const bool is_key = it.direction != Direction::Input && !it.is_key;
      text += is_key ? fmt::format(" {}=\"{{${}\\}}\"", it.name, ++stop)
                     : fmt::format(" {}=\"${}\"", it.name, ++stop);
    }
    const bool is_empty = type.arity.max == 0 || type.category == NodeCategory::SubTree;
    return text + (is_empty ? std::string("/>$0") : fmt::format(">\n  $0\n</{}>", type.id));
  }

  // Only the name is written of a tag that has attributes already, or its end.
  void set_text(CompletionItem item, std::string snippet) {
    const TolerantElement* const own = is_new_ ? nullptr : at_.site.element;
    const bool is_begun = own != nullptr && (own->attribute_count > 0 || own->is_tag_closed);
    if (is_new_) snippet.insert(0, "<");
    if (!is_begun) item.insert = std::move(snippet);
    item.is_snippet = !is_begun;
    if (is_new_ && !at_.question.client.has_snippets) {
      item.insert = "<" + item.label;
      item.is_snippet = false;
    }
    items_.push_back(std::move(item));
  }

  const CompletionSite& at_;
  std::vector<CompletionItem>& items_;
  bool is_new_;
  const TolerantElement* around_;
};

}  // namespace

void complete_elements(const CompletionSite& at, std::vector<CompletionItem>& items) {
  ElementItems(at, items).add();
}

}  // namespace lockstep::host
