// Hints to those who write nodes and attributes of BehaviorTree.CPP or Nav2 in another language.
#pragma once

#include <string>
#include <string_view>

#include "dialect/btcpp/pairs.h"
#include "tree/check/foreign_hints.h"

namespace lockstep::host::btcpp {

extern const ForeignHints kHints;

// Whether it is called otherwise here than `tag`, or an attribute of it is.
bool needs_hint(const NodePair& pair, std::string_view tag);
// Our words for it, as a start tag without its brackets: `Sequence memory="true"`.
std::string instead_of(const NodePair& pair);

}  // namespace lockstep::host::btcpp
