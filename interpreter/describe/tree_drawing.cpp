#include "describe/tree_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostBarriers = 12;

std::string barriers_text(const std::vector<double>& barriers) {
  if (barriers.empty()) return "no barriers";
  if (barriers.size() > kMostBarriers) return fmt::format("{} barriers", barriers.size());
  std::vector<std::string> texts;
  for (const double barrier : barriers) texts.push_back(fmt::format("{:.4g}", barrier));
  return fmt::format("{{{}}}", joined(texts, ", "));
}

// The parameters of a control node that its sign does not show.
std::vector<std::string> control_lines(const Definition& definition, const DefinitionNode& node) {
  const Synchronization synchronization = definition.synchronization(node);
  const HoldingParameters& holding = node.type->holding;
  if (synchronization == Synchronization::Absolute) {
    if (const Value* barriers = definition.constant(node, holding.barriers)) {
      return {barriers_text(std::get<std::vector<double>>(*barriers))};
    }
  } else if (synchronization == Synchronization::Relative) {
    if (const Value* delta = definition.constant(node, holding.delta)) {
      return {fmt::format("Δ = {}", std::get<double>(*delta))};
    }
  }
  return shown_attributes(definition, node);
}

}  // namespace

std::vector<std::string> shown_attributes(const Definition& definition,
                                          const DefinitionNode& node) {
  std::vector<std::string> shown;
  for (const WrittenAttribute& attribute : definition.attributes(node)) {
    shown.push_back(fmt::format("{}=\"{}\"", attribute.name, printable(attribute.value)));
  }
  return shown;
}

std::vector<std::string> shown_lines(const Definition& definition, const DefinitionNode& node) {
  const std::string_view sign = node.type->sign;
  std::vector<std::string> lines{std::string(sign.empty() ? node.type->id : sign)};
  if (node.name != node.type->id) lines.push_back(printable(node.name));
  const auto more =
      sign.empty() ? shown_attributes(definition, node) : control_lines(definition, node);
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

}  // namespace lockstep::host
