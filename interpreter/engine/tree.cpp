#include "engine/tree.h"

#include <algorithm>

#include "core/resource_set.h"

namespace lockstep {

Cell scalar_cell(const Parameter& parameter, const Value& value) {
  Cell cell{.integer = 0};
  if (const auto* flag = std::get_if<bool>(&value)) cell.boolean = *flag;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) cell.integer = *integer;
  if (const auto* number = std::get_if<double>(&value)) cell.number = *number;
  if (const auto* word = std::get_if<std::string>(&value)) {
    cell.integer = std::ranges::find(parameter.choices, *word) - parameter.choices.begin();
  }
  return cell;
}

Cell resource_cell(std::span<const std::string> names, const Value& value) {
  const auto* list = std::get_if<std::string>(&value);
  if (list == nullptr) return {.integer = 0};
  return {.integer = static_cast<std::int64_t>(resource_list(*list, names).set)};
}

std::uint32_t Tree::board_of(NodeIndex node) const {
  const auto next =
      std::ranges::lower_bound(boards.begin() + 1, boards.end(), node, {}, &Board::node);
  auto board = static_cast<std::uint32_t>(next - boards.begin()) - 1;
  while (board != 0 && nodes[boards[board].node].end <= node) board = boards[board].parent;
  return board;
}

std::string Tree::segment(NodeIndex node) const {
  const NodeLabel& label = labels[node];
  std::string segment(label.name);
  if (label.repeat != 0) segment.append("#").append(std::to_string(label.repeat));
  return segment;
}

std::string Tree::path(NodeIndex node) const {
  std::vector<NodeIndex> way{node};
  while (way.back() != labels[way.back()].parent) way.push_back(labels[way.back()].parent);
  std::string path = id;
  for (auto at = way.rbegin(); at != way.rend(); ++at) path.append("/").append(segment(*at));
  return path;
}

}  // namespace lockstep
