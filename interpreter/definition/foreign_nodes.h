// Nodes and attributes of BehaviorTree.CPP and Nav2, and what to write instead. Data for hints; the
// table in docs/language.md says the same, and a test compares the two.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "document/element.h"

namespace lockstep {

// What becomes of the value of an attribute.
enum class ForeignValue : unsigned char {
  Same,
  FromOne,       // less than 1 has a meaning there, and none here
  Milliseconds,  // is in seconds here
  OrEndless,     // -1 is for ever, for which the attribute is left out here
  OneMore,       // counts repetitions, where we count attempts
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

// What to do about an unknown element: "write <Retry attempts="5">"; "" when we know it neither.
std::string foreign_node_hint(std::string_view tag, std::span<const Attribute> attributes);

// What to do about an unknown attribute of a node, known or not.
std::string foreign_attribute_hint(std::string_view tag, const Attribute& attribute);

}  // namespace lockstep
