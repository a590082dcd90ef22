// Hints for users of other languages, whose rooms hand them in: our words for a node or an
// attribute.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "language/document/element.h"

namespace lockstep::host {

// The hints of one language. `tag` is "" if the node only shares its name with one of that
// language.
struct ForeignHints {
  std::string (*for_node)(std::string_view tag, std::span<const Attribute> attributes);
  std::string (*for_attribute)(std::string_view tag, const Attribute& attribute);
  std::string_view (*our_name)(std::string_view tag, std::string_view attribute);
  // Which plugin of lockstep has a node that tools of that language bring; "": none.
  std::string (*of_plugin)(std::string_view tag);
};

// The hint for an unknown element: "write <Retry attempts="5">"; "" if no language has it.
std::string foreign_node_hint(std::string_view tag, std::span<const Attribute> attributes);

// The same in the language itself: which plugin has it.
std::string hint_of_plugin(std::string_view tag);

// The hint for an unknown attribute of a node, whether the node is known or not.
std::string foreign_attribute_hint(std::string_view tag, const Attribute& attribute);
// The parameter of ours that it stands for; "" if there is none.
std::string_view foreign_attribute_name(std::string_view tag, std::string_view attribute);

}  // namespace lockstep::host
