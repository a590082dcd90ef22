#include "tree/advise/group_advice.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/core/wording.h"
#include "tree/advise/holding_circle.h"

namespace lockstep::host {
namespace {

// Says in words, with places, why nobody moves.
class CircleReport {
 public:
  CircleReport(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void add(const std::vector<HoldingLink>& circle) const {
    constexpr std::size_t kMostExplained = 4;
    std::vector<std::string_view> names;
    std::string hint;
    for (std::size_t i = 0; i < circle.size(); ++i) {
      names.push_back(at(circle[i].keeper).name);
      if (i >= kMostExplained) continue;
      hint += (i == 0 ? "" : "; ") + explained(circle[i], circle[(i + 1) % circle.size()]);
    }
    names.push_back(names.front());
    report_.at(at(circle.front().held).place,
               fmt::format("held nodes may wait for each other in a circle: {}", chained(names)),
               hint, Severity::Warning);
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }
  std::string name(std::uint32_t node) const { return fmt::format("'{}'", brief(at(node).name)); }
  std::string with_place(std::uint32_t node) const {
    return fmt::format("{} at {}", name(node), to_text(report_.sources().locate(at(node).place)));
  }
  bool is_inside(std::uint32_t node, std::uint32_t outer) const {
    return outer < node && node < at(outer).end;
  }

  std::string explained(const HoldingLink& link, const HoldingLink& next) const {
    return fmt::format("{} is held by {} {} until {} is there{}", with_place(link.held),
                       name(link.keeper), where(link), with_place(link.awaited), why(link, next));
  }

  std::string where(const HoldingLink& link) const {
    const bool by_delta = definition_.synchronization(at(link.keeper)) == Synchronization::Relative;
    return fmt::format("{} {:.4g}", by_delta ? "beyond" : "at", link.limit);
  }

  // Says how the awaited node and the one that is held next belong together.
  std::string why(const HoldingLink& link, const HoldingLink& next) const {
    std::string text;
    if (link.sequence != link.awaited) {
      text = fmt::format(", which comes after {} in {}", name(link.before), name(link.sequence));
    }
    const std::uint32_t stands = link.before;
    if (is_inside(stands, next.held)) {
      text += fmt::format(", which is inside of what {} holds", name(next.keeper));
    } else if (is_inside(next.held, stands)) {
      text += fmt::format(", in which {} holds a node", name(next.keeper));
    }
    return text;
  }

  const Definition& definition_;
  const Reporter& report_;
};

}  // namespace

void warn_of_circle(const Definition& definition, const Reporter& report) {
  const auto circle = holding_circle(definition);
  if (!circle.empty()) CircleReport(definition, report).add(circle);
}

}  // namespace lockstep::host
