#include "author/edit/unknown_uses.h"

#include <fmt/format.h>

#include <set>

#include "author/edit/entry_uses.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

// The IDs in the models of nodes.
std::set<std::string, std::less<>> modeled_ids(const ProjectTexts& texts) {
  std::set<std::string, std::less<>> ids;
  for (std::uint32_t i = 0; i < texts.size(); ++i) {
    const auto elements = texts.document(i).elements();
    for (const std::uint32_t models : children_in(elements, 0)) {
      if (elements[models].tag != "TreeNodesModel") continue;
      for (const std::uint32_t model : children_in(elements, models))
        ids.emplace(texts.value({i, model}, "ID"));
    }
  }
  return ids;
}

class UnknownFinder {
 public:
  explicit UnknownFinder(const ProjectTexts& texts) : texts_(texts), modeled_(modeled_ids(texts)) {}

  std::optional<Problem> find(ElementAt part) {
    const std::uint32_t end = texts_.document(part.document).elements()[part.element].end;
    for (ElementAt at = part; at.element < end; ++at.element)
      if (auto unknown = visit(at)) return unknown;
    return std::nullopt;
  }

 private:
  std::optional<Problem> visit(ElementAt at) {
    const std::string_view tag = texts_.document(at.document).elements()[at.element].tag;
    if (tag == "BehaviorTree") return std::nullopt;
    const std::string_view id = texts_.value(at, "ID");
    if (texts_.is_sub_tree(at)) {
      const auto inner = passes_on_all(texts_, at) ? texts_.find_tree(id) : std::nullopt;
      return inner && seen_.emplace(id).second ? find(*inner) : std::nullopt;
    }
    const NodeType* const type = texts_.type_of(at);
    if (type == nullptr && !modeled_.contains(is_explicit_tag(tag) ? id : tag))
      return Problem{fmt::format("no plugin has '{}'", brief(tag)), "its plugin knows its entries"};
    if (type != nullptr && type->opens_entries)
      return Problem{fmt::format("'{}' may use entries that no port names", brief(tag)),
                     "its code knows which: change them by hand"};
    return std::nullopt;
  }

  const ProjectTexts& texts_;
  std::set<std::string, std::less<>> modeled_, seen_;
};

}  // namespace

std::optional<Problem> unknown_uses(const ProjectTexts& texts, ElementAt part) {
  return UnknownFinder(texts).find(part);
}

}  // namespace lockstep::host
