#include "author/server/features/refactorings.h"

#include <fmt/format.h>

#include <algorithm>

#include "author/edit/edits.h"
#include "author/edit/element_text.h"
#include "author/edit/subtree_edits.h"
#include "author/server/features/actions.h"
#include "author/server/features/names.h"
#include "author/server/features/site.h"
#include "author/server/features/trial.h"
#include "author/server/features/workspace_edit.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "language/document/byte_order_mark.h"
#include "language/document/value_text.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kExtract = "refactor.extract", kInline = "refactor.inline",
                           kRewrite = "refactor.rewrite";
constexpr std::string_view kKinds[] = {kExtract, kInline, kRewrite};

// A check of a larger text takes so long that the editor would wait.
constexpr std::size_t kMostBytes = std::size_t{2} << 20;

// A language has those whose tag and attribute it knows.
struct Wrapping {
  std::string_view tag, attribute = {}, value = {};
};
constexpr Wrapping kWrappings[] = {
    {"Sequence"},
    {"Fallback"},
    {"Parallel"},
    {"ParallelAbsolute", "barriers", "0.25;0.5;0.75"},
    {"Inverter"},
    {"Retry", "attempts", "3"},
    {"RetryUntilSuccessful", "num_attempts", "3"},
    {"Timeout", "seconds", "10"},
    {"Timeout", "msec", "10000"},
};

// A node around one child that changes no tick of it.
constexpr std::string_view kSame = "Sequence";

struct Nodes {
  std::uint32_t first, last;  // siblings
};

// The numbers of elements in the document of the file.
std::optional<Nodes> selected_nodes(const Question& question, const ProjectTexts& texts) {
  const TolerantTree& tree = question.file.tree();
  const Positions& positions = question.file.positions();
  const auto range = question.params.range.value_or(PositionRange());
  const SelectedElements selected =
      selected_elements(tree, {positions.byte_at(range.first), positions.byte_at(range.second)});
  if (selected.first == nullptr) return std::nullopt;
  const Document& document = texts.document(0);
  const auto number_of = [&](const TolerantElement& element) {
    const std::size_t begin = element.begin - byte_order_mark(tree.text).size();
    const auto place = [&](const Element& it) { return offset_of(document, it.place); };
    const auto elements = document.elements();
    return static_cast<std::uint32_t>(std::ranges::lower_bound(elements, begin, {}, place) -
                                      elements.begin());
  };
  const Nodes nodes{number_of(*selected.first), number_of(*selected.last)};
  return texts.tree_around({0, nodes.first}) ? std::optional(nodes) : std::nullopt;
}

// What a tree calls the node.
std::string_view kind_of(const ProjectTexts& texts, ElementAt node) {
  const std::string_view tag = texts.document(node.document).elements()[node.element].tag;
  return is_explicit_tag(tag) ? texts.value(node, "ID") : tag;
}

// The name of the node, or what it is and in which tree.
std::string free_id(const ProjectTexts& texts, ElementAt node) {
  std::string name(texts.value(node, "name"));
  if (name.empty() || name.find_first_of("/{}$") != name.npos) {
    const ElementAt tree = texts.tree_around(node).value();
    name = fmt::format("{}{}", texts.value(tree, "ID"), kind_of(texts, node));
  }
  std::string id = name;
  const auto is_taken = [&] {
    return texts.find_tree(id) || texts.is_named_file(id) || texts.catalog().find(id) != nullptr;
  };
  for (int number = 2; is_taken(); ++number) id = fmt::format("{}{}", name, number);
  return id;
}

// Whether the node, ticked again after it has completed, does not do the same with a reset as
// without one. Then its scripts before a tick do not run, an action has its result, and one of a
// plugin does what it likes.
bool differs_without_reset(const ProjectTexts& texts, ElementAt node) {
  for (const Attribute& it : texts.document(node.document).attributes(node.element)) {
    const auto hook = hook_named(it.name, texts.rules());
    if (hook && *hook <= Hook::While) return true;
  }
  const NodeType* const type = texts.type_of(node);
  if (type == nullptr) return !texts.is_sub_tree(node);
  return type->can_run || !type->plugin.empty() || type->mock != nullptr;
}

// Whether a script may read another node, or none, where nodes around it come or go: it names one
// by a path, by its number among its siblings, or as `kind`, which is the default name of some.
bool reads_by_place(const Question& question, std::string_view kind) {
  const auto& meaning = question.file.analysis->meaning;
  if (meaning == nullptr) return false;
  const auto is_by_place = [&](const Reading& it) {
    return it.what != Reading::What::Owner &&
           (it.of == kind || it.of.find_first_of("/#") != std::string::npos);
  };
  return std::ranges::any_of(meaning->definition.scripts, [&](const BoundScript& it) {
    return it.code != nullptr && std::ranges::any_of(it.code->readings(), is_by_place);
  });
}

class Refactorings {
 public:
  Refactorings(const Question& question, const ProjectTexts& texts, Nodes nodes)
      : question_(question),
        texts_(texts),
        document_(texts.document(0)),
        node_(nodes.first),
        last_(nodes.last),
        kind_(brief(kind_of(texts, {0, node_}))),
        trial_(question, texts) {}

  std::vector<Json> all() {
    const std::vector<std::string>& kinds = question_.params.kinds;
    const bool is_one = node_ == last_;
    if (is_one && is_wanted(kExtract, kinds)) extract();
    if (is_one && is_wanted(kInline, kinds)) put_in_place();
    if (!is_wanted(kRewrite, kinds)) return std::move(actions_);
    for (const Wrapping& it : kWrappings) wrap(it);
    if (!is_one) return std::move(actions_);
    unwrap();
    move();
    offer(kRewrite, fmt::format("Delete {}", kind_), delete_element(document_, node_));
    return std::move(actions_);
  }

 private:
  void offer(std::string_view kind, std::string title, const Result<ProjectEdit>& edit) {
    if (!edit || !trial_.accepts(*edit)) return;
    actions_.push_back(Json{{"title", std::move(title)},
                            {"kind", kind},
                            {"edit", workspace_edit(question_, texts_, *edit)}});
  }

  // The edit is one of the file.
  void offer(std::string_view kind, std::string title, Result<TextEdit> edit) {
    if (!edit) return;
    ProjectEdit all(texts_.size());
    all[0] = std::move(*edit);
    offer(kind, std::move(title), Result<ProjectEdit>(std::move(all)));
  }

  void extract() {
    if (texts_.is_sub_tree({0, node_}) || stays_in_place({0, node_})) return;
    if (reads_by_place(question_, kind_)) return;
    const std::string id = free_id(texts_, {0, node_});
    offer(kExtract, fmt::format("Extract into the SubTree '{}'", brief(id)),
          extract_subtree(texts_, {0, node_}, id));
  }

  void put_in_place() {
    const std::string_view id = texts_.value({0, node_}, "ID");
    const auto tree = texts_.find_tree(id);
    if (stays_in_place({0, node_}) || reads_by_place(question_, id)) return;
    if (tree && stays_in_place({tree->document, tree->element + 1})) return;
    offer(kInline, fmt::format("Put the tree '{}' in the place of this SubTree", brief(id)),
          inline_subtree(texts_, {0, node_}));
  }

  void wrap(const Wrapping& in) {
    const NodeType* const type = texts_.catalog().find(in.tag);
    if (type == nullptr || !type->plugin.empty()) return;
    const bool changes = stays_in_place({0, node_}) || reads_by_place(question_, kSame);
    if (in.tag == kSame && changes) return;
    if (!in.attribute.empty() && parameter_of(type, in.attribute) == nullptr) return;
    std::string tag(in.tag);
    if (!in.attribute.empty()) tag += fmt::format(" {}={}", in.attribute, quoted(in.value));
    offer(kRewrite, fmt::format("Wrap in {}", in.tag), wrap_elements(document_, node_, last_, tag));
  }

  void unwrap() {
    const auto elements = document_.elements();
    if (elements[node_].end == node_ + 1) return;
    const bool is_one = elements[node_ + 1].end == elements[node_].end;
    const bool changes = stays_in_place({0, node_ + 1}) || reads_by_place(question_, kSame);
    if (is_one && kind_ == kSame && changes) return;
    offer(kRewrite, fmt::format("Replace {} by its {}", kind_, is_one ? "child" : "children"),
          unwrap_element(document_, node_));
  }

  std::uint32_t parent() const {
    const auto elements = document_.elements();
    std::uint32_t parent = node_ - 1;
    while (elements[parent].end <= node_) --parent;
    return parent;
  }

  // Whether the node around the selected one may tick it again without a reset.
  bool is_kept() const {
    const NodeType* const around = texts_.type_of({0, parent()});
    if (around == nullptr) return false;
    const bool is_of_plugin = !around->plugin.empty() || around->mock != nullptr;
    return is_of_plugin || (around->keeps_first_child && node_ == parent() + 1);
  }

  // Whether the node would do something else inside of another one in the place of the selected
  // one, since that resets it.
  bool stays_in_place(ElementAt node) const {
    return is_kept() && differs_without_reset(texts_, node);
  }

  void move() {
    const auto elements = document_.elements();
    std::uint32_t before = 0;
    for (const std::uint32_t it : children_in(elements, parent())) {
      if (before != 0 && it == node_)
        offer(kRewrite, "Move up", swap_elements(document_, before, it));
      if (before == node_) offer(kRewrite, "Move down", swap_elements(document_, before, it));
      before = it;
    }
  }

  const Question& question_;
  const ProjectTexts& texts_;
  const Document& document_;  // of the file
  std::uint32_t node_, last_;
  std::string kind_;
  Trial trial_;
  std::vector<Json> actions_;
};

}  // namespace

std::vector<Json> refactorings(const Question& question) {
  if (kind_of_file(question.file.path) != FileKind::Tree) return {};
  if (question.file.bytes().size() > kMostBytes) return {};
  const FileParams& params = question.params;
  if (params.is_automatic && params.kinds.empty()) return {};
  const bool is_any = std::ranges::any_of(
      kKinds, [&](std::string_view kind) { return is_wanted(kind, params.kinds); });
  if (!is_any) return {};
  const auto texts = project_texts(question);
  if (!texts) return {};
  const auto nodes = selected_nodes(question, *texts);
  if (!nodes) return {};
  return Refactorings(question, *texts, *nodes).all();
}

}  // namespace lockstep::host
