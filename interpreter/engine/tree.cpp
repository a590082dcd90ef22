#include "engine/tree.h"

#include <algorithm>

namespace lockstep::host {

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

std::uint32_t Tree::board_of(NodeIndex node) const {
  const auto next =
      std::ranges::lower_bound(boards.begin() + 1, boards.end(), node, {}, &Board::node);
  auto board = static_cast<std::uint32_t>(next - boards.begin()) - 1;
  while (board != 0 && nodes[boards[board].node].end <= node) board = boards[board].parent;
  return board;
}

namespace {

void append_segment(const NodeLabel& label, std::string& text) {
  text.append(label.name);
  if (label.repeat != 0) text.append("#").append(std::to_string(label.repeat));
}

// `more`: the bytes that come behind it.
void append_path(const Tree& tree, NodeIndex node, std::size_t more, std::string& text) {
  const NodeLabel& label = tree.labels[node];
  const std::size_t all = more + label.name.size() + 1;
  if (label.parent != node) {
    append_path(tree, label.parent, all, text);
  } else {
    text.reserve(text.size() + all);
  }
  append_segment(label, text.append("/"));
}

}  // namespace

std::string Tree::segment(NodeIndex node) const {
  std::string segment;
  append_segment(labels[node], segment);
  return segment;
}

std::string Tree::path(NodeIndex node) const {
  std::string text;
  path(node, text);
  return text;
}

void Tree::path(NodeIndex node, std::string& text) const {
  text = id;
  append_path(*this, node, 0, text);
}

}  // namespace lockstep::host
