// The types of elements that a plugin describes one by one: lockstep_leaf_type::describe.
#pragma once

#include <memory>

#include "base/core/element_types.h"
#include "leaves/plugin/contract/descriptor.h"

namespace lockstep::host {

// Asks for a leaf type in place of lockstep_leaf_type::describe, for a plugin in another process.
class LeafDescriber {
 public:
  virtual ~LeafDescriber() = default;
  // The type stays valid as long as this.
  virtual tl::expected<const lockstep_leaf_type*, ElementRefusal> describe(
      std::string_view id, std::span<const FixedText> fixed) = 0;
};

// Whether a refusal says that the plugin breaks the contract, not what is wrong with an element.
bool is_breach(const ElementRefusal& refusal);

// A port of an element that `type`, which describes it, has neither itself nor a pattern for; "":
// none. The contract forbids it, and no tree can bind it by an attribute.
std::string_view port_without_pattern(const NodeType& type, const NodeType& described);

// That each of the elements whose constants the type declares is refused.
std::string describes_nothing(const NodeType& type);

// The types of the elements of `leaf`. It and `plugin` outlive the result.
std::unique_ptr<const ElementTypes> described_types(const HostedPlugin& plugin,
                                                    const Descriptors::Leaf& leaf);

}  // namespace lockstep::host
