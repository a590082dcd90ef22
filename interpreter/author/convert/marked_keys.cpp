#include "author/convert/marked_keys.h"

#include "author/convert/scripts.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "language/expression/token.h"

namespace lockstep::host {

MarkedKeys::MarkedKeys(const Document& document, const Conversion& conversion,
                       const Circumstances& circumstances)
    : document_(document), conversion_(conversion), circumstances_(circumstances) {
  const auto elements = document.elements();
  for (const std::uint32_t part : children_in(elements, 0))
    if (elements[part].tag == "BehaviorTree") find_in(part);
}

void MarkedKeys::find_in(std::uint32_t tree) {
  Keys& keys = own_[tree];
  for (std::uint32_t node = tree + 1; node < document_.elements()[tree].end; ++node) {
    if (const std::uint32_t inner = circumstances_.tree_of(node); inner != 0) {
      ++subtrees_[inner];
      if (circumstances_.passes_on_all(node)) passed_on_[tree].push_back(inner);
    }
    const NodeType* const type = type_at(document_, node, conversion_.from_nodes);
    for (const Attribute& it : document_.attributes(node)) {
      if (is_script_at(it.name, type, conversion_.from)) find_in_script(it.value, keys);
      if (is_entry_at(it.name, type) && it.value.starts_with('_')) keys.insert(it.value);
      for (auto at = it.value.find("{_"); at != it.value.npos; at = it.value.find("{_", at + 1)) {
        const std::string_view key = it.value.substr(at + 1, it.value.find('}', at) - at - 1);
        if (is_identifier(key)) keys.insert(key);
      }
    }
  }
  for (const std::string_view key : keys) ++trees_[key];
}

void MarkedKeys::find_in_script(std::string_view script, Keys& keys) const {
  TokenReader reader;
  for (std::size_t offset = 0;;) {
    const auto token = reader.next(script, offset);
    if (!token || token->symbol == Symbol::End) return;
    if (token->symbol == Symbol::Name && token->text.starts_with('_')) keys.insert(token->text);
  }
}

const MarkedKeys::Keys& MarkedKeys::inside(std::uint32_t tree) {
  const auto [found, is_new] = inside_.emplace(tree, own_[tree]);
  Keys& keys = found->second;
  constexpr int kMostNested = 1000;                    // a deeper tree is an error
  if (!is_new || levels_ == kMostNested) return keys;  // also for a tree that contains itself
  ++levels_;
  for (const std::uint32_t inner : passed_on_[tree]) {
    const Keys& more = inside(inner);
    if (&more != &keys) keys.insert(more.begin(), more.end());
  }
  --levels_;
  return keys;
}

std::vector<std::string_view> MarkedKeys::differ(std::uint32_t subtree) {
  const std::uint32_t tree = circumstances_.tree_of(subtree);
  std::vector<std::string_view> differ;
  if (tree == 0 || !circumstances_.passes_on_all(subtree)) return differ;
  for (const std::string_view key : inside(tree))
    if (subtrees_[tree] > 1 || trees_[key] > 1) differ.push_back(key);
  return differ;
}

}  // namespace lockstep::host
