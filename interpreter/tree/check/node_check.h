// The checks of a node and its element that both languages share: the explicit form and the number
// of children.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "language/document/element.h"
#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// "Action", "Condition", "Control" or "Decorator"; "" of another category.
std::string_view explicit_tag(NodeCategory category);
// Whether an element with this tag names its type with an ID.
bool is_explicit_tag(std::string_view tag);

struct ElementOf {
  std::span<const Element> all;
  std::uint32_t index;
};

void check_arity(ElementOf element, const CheckedNode& node, const Reporter& report);

}  // namespace lockstep::host
