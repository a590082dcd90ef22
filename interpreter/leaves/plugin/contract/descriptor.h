// The descriptors of a plugin: checked against the rules of lockstep/leaf.h, copied to the full
// size that this host knows, and translated to node types. Calls no function of the plugin but
// describe.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "base/core/element_types.h"
#include "base/core/node_type.h"
#include "base/core/problem.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

class LeafDescriber;
class RemotePlugin;

struct HostedPlugin : lockstep_plugin {
  RemotePlugin* remote = nullptr;      // null: its functions are the plugin's own
  LeafDescriber* describer = nullptr;  // null: leaf types describe elements themselves
  bool is_local = false;               // it cannot be isolated
  bool answers_late = false;           // on the wall clock, a tick does not wait for an action
};

struct Descriptors {
  // Full size: fields that the plugin's structs do not have are zero.
  HostedPlugin plugin{};
  struct Leaf {
    lockstep_leaf_type type{};
    std::vector<Parameter> parameters;                  // its ports, in order
    std::deque<std::vector<std::string_view>> choices;  // of its parameters
    NodeType node_type{};
    std::unique_ptr<const ElementTypes> element_types = {};  // null: all elements are alike
  };
  std::vector<std::unique_ptr<Leaf>> leaves;
};

// `exported_size` is the size of `entry` as the shared object's symbol table has it; 0 = not known.
// The descriptors point into the plugin's strings.
std::optional<Problem> read_descriptors(const lockstep_plugin& entry, std::size_t exported_size,
                                        Descriptors& descriptors);

// The rest of it is known.
NodeType node_type_of(const HostedPlugin& plugin, const Descriptors::Leaf& leaf);

// Letters, digits, '_' and '-'.
bool is_plugin_name(std::string_view name);

inline std::string_view text_or_empty(const char* text) {
  return text == nullptr ? "" : text;
}

// As much of a struct as its owner wrote; the rest is zero.
template <class Struct>
Struct covered_copy(const Struct* from, std::size_t size) {
  Struct copy{};
  std::memcpy(static_cast<void*>(&copy), static_cast<const void*>(from),
              size < sizeof copy ? size : sizeof copy);
  return copy;
}

}  // namespace lockstep::host
