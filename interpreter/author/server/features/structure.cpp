#include "author/server/features/structure.h"

#include <fmt/format.h>

#include "author/server/features/names.h"

namespace lockstep::host {
namespace {

// As the protocol numbers kinds of symbols.
enum class SymbolKind : int { Module = 2, Class = 5, Property = 7, Function = 12, Event = 24 };

class Outline {
 public:
  explicit Outline(const Question& question)
      : tree_(question.file.tree()),
        positions_(question.file.positions()),
        catalog_(question.file.analysis->catalog) {}

  Json all() const {
    std::vector<Json> symbols;
    for (std::uint32_t i = 0; i < tree_.elements.size(); i = tree_.elements[i].last)
      symbols.push_back(symbol(i, 0));
    return Json::array(std::move(symbols));
  }

 private:
  static constexpr unsigned kDeepest = 200;  // a client in JavaScript has no more room either

  Json symbol(std::uint32_t index, unsigned depth) const {
    const TolerantElement& it = tree_.elements[index];
    const std::string_view tag = it.tag.empty() ? "?" : it.tag;
    std::string_view name = tree_.value_of(it, "name");
    if (name.empty()) name = tree_.value_of(it, "ID");
    if (name.empty()) name = tree_.value_of(it, "path");
    const std::size_t tag_end = tree_.offset_of(it.tag) + it.tag.size();
    Json json{{"name", std::string(name.empty() ? tag : name)},
              {"detail", std::string(name.empty() ? "" : tag)},
              {"kind", static_cast<int>(kind_of(it))},
              {"range", positions_.json({it.begin, std::max(it.end, tag_end)})},
              {"selectionRange", positions_.json({it.begin, tag_end})}};
    std::vector<Json> children;
    for (std::uint32_t child = index + 1; child < it.last && depth < kDeepest;
         child = tree_.elements[child].last)
      children.push_back(symbol(child, depth + 1));
    if (!children.empty()) json["children"] = Json::array(std::move(children));
    return json;
  }

  SymbolKind kind_of(const TolerantElement& element) const {
    if (element.tag == "BehaviorTree") return SymbolKind::Class;
    const NodeType* const type = type_of(tree_, element, catalog_);
    if (type == nullptr) return SymbolKind::Property;
    if (type->category == NodeCategory::Action) return SymbolKind::Function;
    return type->category == NodeCategory::Condition ? SymbolKind::Event : SymbolKind::Module;
  }

  const TolerantTree& tree_;
  const Positions& positions_;
  const Catalog& catalog_;
};

}  // namespace

Json document_symbols(const Question& question) {
  return Outline(question).all();
}

Json folding_ranges(const Question& question) {
  const TolerantTree& tree = question.file.tree();
  const Positions& positions = question.file.positions();
  std::vector<Json> ranges;
  const auto add = [&](std::size_t begin, std::size_t end, const char* kind) {
    const auto first = positions.position_of(begin).line;
    const auto last = positions.position_of(end).line;
    if (last <= first) return;
    Json range{{"startLine", first}, {"endLine", last}};
    if (kind != nullptr) range["kind"] = kind;
    ranges.push_back(std::move(range));
  };
  for (const TolerantElement& it : tree.elements) add(it.begin, it.end, nullptr);
  for (std::size_t i = 0; i + 1 < tree.comments.size(); i += 2)
    add(tree.comments[i], tree.comments[i + 1], "comment");
  return Json::array(std::move(ranges));
}

}  // namespace lockstep::host
