// Nodes and attributes of BehaviorTree.CPP and Nav2, and their lockstep equivalents, as data for
// hints. A test compares it with the table in docs/language.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "document/element.h"

namespace lockstep {

// How the value of an attribute is converted.
enum class ForeignValue : unsigned char {
  Same,
  FromOne,        // less than 1 has a meaning there, and none here
  Milliseconds,   // is in seconds here
  WithoutBraces,  // a {key} there, its name here
  OrEndless,      // -1 is for ever, for which the attribute is left out here
};

struct ForeignAttribute {
  std::string_view name;
  std::string_view ours;  // "": none
  ForeignValue value = ForeignValue::Same;
};

struct ForeignNode {
  std::string_view tag;   // "": any node
  std::string_view ours;  // as a start tag without its brackets: `Sequence memory="true"`; "": none
  std::span<const ForeignAttribute> attributes = {};
  std::string_view remark = {};  // what is different, or what to do instead
};

std::span<const ForeignNode> foreign_nodes();

// The hint for an unknown element: "write <Retry attempts="5">"; "" if this table does not have it.
std::string foreign_node_hint(std::string_view tag, std::span<const Attribute> attributes);

// The hint for an unknown attribute of a node, whether the node is known or not.
std::string foreign_attribute_hint(std::string_view tag, const Attribute& attribute);
// The parameter of ours that it stands for; "" if there is none.
std::string_view foreign_attribute_name(std::string_view tag, std::string_view attribute);

}  // namespace lockstep
