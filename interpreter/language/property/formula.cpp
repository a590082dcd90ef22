#include "language/property/formula.h"

#include "language/expression/relation.h"

namespace lockstep::host {

bool Formula::holds(std::span<const FormulaStep> code, std::span<const SeenNode> seen,
                    std::span<const bool> compared) const {
  using What = FormulaStep::What;
  std::uint64_t stack = 0;  // the top is the lowest bit
  const auto push = [&stack](bool bit) { stack = stack << 1u | (bit ? 1u : 0u); };
  for (const FormulaStep& step : code) {
    switch (step.what) {
      case What::Status:
        push((step.statuses >> index_of(seen[step.place].status) & 1u) != 0);
        break;
      case What::Ticked:
        push(seen[step.place].ticked);
        break;
      case What::Held:
        push(seen[step.place].held);
        break;
      case What::Progress: {
        const ProgressComparison& it = progress[step.place];
        push(are_related_as_progress(seen[it.node].progress, it.relation, it.constant));
        break;
      }
      case What::Entry:
        push(compared[step.place]);
        break;
      case What::And:
        stack = stack >> 1u & (stack | ~std::uint64_t{1});
        break;
      case What::Or:
        stack = stack >> 1u | (stack & 1u);
        break;
      case What::Not:
        stack ^= 1u;
        break;
    }
  }
  return (stack & 1u) != 0;
}

}  // namespace lockstep::host
