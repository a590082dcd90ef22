// The meaning of a node's attributes for its type. Nodes of one type mostly have the same
// attributes, so their names are only compared with those of the node before. Where these differ,
// the attributes are looked up, and the defaults of the others are read.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/document/element.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// The parts of an element that the check of a node reads.
struct NodeElement {
  Place place;
  std::span<const Attribute> attributes;
  bool is_explicit;  // its ID attribute names the type
};

// Every node may have these.
constexpr bool is_common_attribute(std::string_view name) {
  return name == "name" || name == "_description";
}

struct AttributeLayout {
  static constexpr std::uint32_t kNone = 0xffffffff;

  // A parameter that is to be looked at in each node, and its attribute; kNone: it is left out.
  struct Given {
    std::uint32_t parameter, attribute;
  };

  std::vector<std::string_view> names;  // of the attributes
  bool is_explicit = false;
  std::uint32_t name = kNone;  // the attribute that names the node
  bool has_unknown = false;    // an attribute that the type does not have
  bool has_hooks = false;      // an attribute with a script around ticks
  bool has_at_cut = false;     // one of LeafAtCut
  std::vector<Given> given;    // in the order of the parameters
  // One for each parameter; complete where the parameter is not in `given`.
  std::vector<CheckedPort> ports;
  // For each parameter its default in CheckedTrees::values, or kNone.
  std::vector<std::uint32_t> defaults;
  // For each parameter the constant that a node gave last, and its text: the next one may share it.
  struct Constant {
    std::string_view text = {};
    std::uint32_t value = kNone;  // in CheckedTrees::values
  };
  std::vector<Constant> last;

  bool fits(const NodeElement& element) const;
};

class AttributeLayouts {
 public:
  // Returns the layout of a node of this type. Valid until the next call. Appends defaults to
  // trees.values.
  AttributeLayout& of(const NodeElement& element, const NodeType& type, CheckedTrees& trees);

 private:
  std::unordered_map<const NodeType*, AttributeLayout> last_;  // of each type
  const NodeType* last_type_ = nullptr;
  AttributeLayout* last_of_type_ = nullptr;
};

}  // namespace lockstep::host
