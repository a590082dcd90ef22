#include "cli/tree_drawing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/diagnostics.h"

namespace lockstep {
namespace {

constexpr std::size_t kMostBarriers = 12;

const Value& parameter(const Drawn& drawn, const DefinitionNode& node, std::string_view name) {
  std::uint32_t place = node.first;
  for (const Parameter& it : node.type->parameters) {
    if (it.name == name) break;
    ++place;
  }
  return drawn.definition.values[place];
}

std::string barriers_text(const std::vector<double>& barriers) {
  if (barriers.empty()) return "no barriers";
  if (barriers.size() > kMostBarriers) return fmt::format("{} barriers", barriers.size());
  return fmt::format("{{{:.4g}}}", fmt::join(barriers, ", "));
}

// What the sign of a control node does not say.
std::vector<std::string> control_lines(const Drawn& drawn, const DefinitionNode& node) {
  if (node.type->synchronization == Synchronization::Absolute) {
    return {barriers_text(std::get<std::vector<double>>(parameter(drawn, node, "barriers")))};
  }
  if (node.type->synchronization == Synchronization::Relative) {
    return {fmt::format("Δ = {}", std::get<double>(parameter(drawn, node, "delta")))};
  }
  return shown_attributes(drawn, node);
}

}  // namespace

std::vector<std::string> shown_attributes(const Drawn& drawn, const DefinitionNode& node) {
  const Document& document = *drawn.project.documents[node.document];
  const bool explicit_form = document.elements()[node.element].tag != node.type->id;
  std::vector<std::string> shown;
  for (const Attribute& attribute : document.attributes(node.element)) {
    if (attribute.name == "name" || (explicit_form && attribute.name == "ID")) continue;
    shown.push_back(fmt::format("{}=\"{}\"", attribute.name, printable(attribute.value)));
  }
  return shown;
}

std::vector<std::string> shown_lines(const Drawn& drawn, const DefinitionNode& node) {
  const std::string_view sign = node.type->sign;
  std::vector<std::string> lines{std::string(sign.empty() ? node.type->id : sign)};
  if (node.name != node.type->id) lines.push_back(printable(node.name));
  const auto more = sign.empty() ? shown_attributes(drawn, node) : control_lines(drawn, node);
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

}  // namespace lockstep
