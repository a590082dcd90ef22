// What a file shows of the circumstances under which a node of one language is not quite that of
// the other one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "author/convert/convert.h"
#include "dialect/btcpp/pairs.h"

namespace lockstep::host {

class Circumstances {
 public:
  Circumstances(const Document& document, const Conversion& conversion);

  bool apply(btcpp::When when, std::uint32_t element);
  // Whether a SubTree passes on entries without an attribute.
  bool passes_on_all(std::uint32_t subtree) const;
  std::string_view type_of(std::uint32_t element) const;
  // The tree of a SubTree, if this file has it; 0 if not.
  std::uint32_t tree_of(std::uint32_t subtree) const;

 private:
  bool has_script(std::uint32_t element, Hook hook) const;
  void find_held();
  bool may_run(std::uint32_t element);
  bool may_run_itself(std::uint32_t node);
  bool tree_may_run(std::uint32_t tree);
  bool has_unknown_leaf(std::uint32_t element) const;
  bool is_modeled_action(std::string_view type) const;
  enum class Runs : std::uint8_t { Unknown, Never, Perhaps };
  // What may skip an element: nothing, a leaf of a plugin that returns Skipped, a script.
  enum class Skips : std::uint8_t { Unknown, Nothing, Leaf, Script };
  Skips skips(std::uint32_t element);
  Skips find_skips(std::uint32_t element);
  bool is_decided_by_script(std::uint32_t element) const;

  const Document& document_;
  const Conversion& conversion_;
  std::span<const Element> elements_;
  std::unordered_map<std::string_view, std::uint32_t> trees_;  // of each ID: the first
  std::unordered_set<std::string_view> modeled_, modeled_actions_;
  std::vector<bool> is_held_;  // below a synchronized node, also by way of a SubTree
  std::vector<Runs> runs_;     // of trees, as far as it is known
  std::vector<Skips> skips_;   // as far as it is known
  int levels_ = 0;             // of skips() or tree_may_run(), one in the other
};

}  // namespace lockstep::host
