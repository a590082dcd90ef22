// What a file shows of the circumstances under which a node of one language is not quite that of
// the other one.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "author/convert/convert.h"
#include "dialect/btcpp/pairs.h"

namespace lockstep::host {

class Circumstances {
 public:
  Circumstances(const Document& document, const Conversion& conversion);

  bool apply(btcpp::When when, std::uint32_t element) const;

 private:
  std::string_view type_of(std::uint32_t element) const;
  // The tree of a SubTree, if this file has it; 0 if not.
  std::uint32_t tree_of(std::uint32_t subtree) const;
  bool has_script(std::uint32_t element, Hook hook) const;
  void find_held();
  bool may_run(std::uint32_t element) const;
  bool is_modeled_action(std::string_view type) const;
  bool may_be_skipped(std::uint32_t element, int most_subtrees) const;
  bool is_decided_by_script(std::uint32_t element) const;

  const Document& document_;
  const Conversion& conversion_;
  std::span<const Element> elements_;
  std::vector<bool> is_held_;  // below a synchronized node, also by way of a SubTree
};

}  // namespace lockstep::host
