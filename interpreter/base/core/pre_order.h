// A tree in pre-order: the node at i has its descendants in (i, nodes[i].end). The first child is
// at i + 1, and the sibling after child c at nodes[c].end.
#pragma once

#include <cstdint>

namespace lockstep::host {

template <class Nodes>
struct ChildIterator {
  const Nodes& nodes;
  std::uint32_t at;

  std::uint32_t operator*() const { return at; }
  void operator++() { at = nodes[at].end; }
  bool operator!=(std::uint32_t end) const { return at != end; }
};

template <class Nodes>
struct ChildRange {
  const Nodes& nodes;
  std::uint32_t parent;

  ChildIterator<Nodes> begin() const { return {nodes, parent + 1}; }
  std::uint32_t end() const { return nodes[parent].end; }
};

// The indices of the children: for (const std::uint32_t child : children_in(nodes, parent)).
template <class Nodes>
ChildRange<Nodes> children_in(const Nodes& nodes, std::uint32_t parent) {
  return {nodes, parent};
}

}  // namespace lockstep::host
