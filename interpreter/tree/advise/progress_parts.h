// Which part of the progress of a node one below it makes up.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/core/pre_order.h"
#include "tree/definition.h"

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
      if (around.type->progress_share == ProgressShare::EachChild) {
        const double place = places_[node], children = around.children;
        part = {(place + part.begin) / children, (place + part.end) / children};
      } else if (around.type->progress_share == ProgressShare::EachRound) {
        part = in_rounds(part, definition_.rounds(around));
      }
    }
    return part;
  }

 private:
  static ProgressPart in_rounds(ProgressPart part, std::optional<std::int64_t> times) {
    if (!times) return {0, 1};
    if (*times <= 0) return part;
    const auto rounds = static_cast<double>(*times);
    return {part.begin / rounds, (rounds - 1 + part.end) / rounds};
  }

  const Definition& definition_;
  std::vector<std::uint32_t> places_;  // of each node, among its siblings
};

}  // namespace lockstep::host
