// Which part of the progress of a node one below it makes up.
#pragma once

#include <cstdint>
#include <vector>

#include "core/pre_order.h"
#include "definition/definition.h"

namespace lockstep::host {

struct ProgressPart {
  double begin = 0, end = 1;
};

class ProgressParts {
 public:
  explicit ProgressParts(const Definition& definition)
      : definition_(definition), places_(definition.nodes.size()) {
    for (std::uint32_t node = 0; node < definition.nodes.front().end; ++node) {
      std::uint32_t place = 0;
      for (const std::uint32_t child : children_in(definition.nodes, node)) {
        places_[child] = place++;
      }
    }
  }

  ProgressPart part(std::uint32_t node, std::uint32_t top) const {
    ProgressPart part;
    for (; node != top; node = definition_.nodes[node].parent) {
      const DefinitionNode& around = definition_.nodes[definition_.nodes[node].parent];
      if (around.type->goes_on_after == Status::Success) {
        const double place = places_[node], children = around.children;
        part = {(place + part.begin) / children, (place + part.end) / children};
      } else if (definition_.has(around, "times")) {
        part = in_rounds(part, around);
      }
    }
    return part;
  }

 private:
  ProgressPart in_rounds(ProgressPart part, const DefinitionNode& repeat) const {
    const Value* times = definition_.constant(repeat, "times");
    if (times == nullptr) return {0, 1};
    const auto rounds = static_cast<double>(std::get<std::int64_t>(*times));
    return {part.begin / rounds, (rounds - 1 + part.end) / rounds};
  }

  const Definition& definition_;
  std::vector<std::uint32_t> places_;  // of each node, among its siblings
};

}  // namespace lockstep::host
