#include "groot/boards.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <variant>

namespace lockstep::host {
namespace {

// The name of the main tree's board, where it is not asked for by its own.
constexpr std::string_view kMain = "ROOT";

struct ToJson {
  Json operator()(const NoValue&) const { return {}; }
  Json operator()(const Object&) const { return {}; }
  Json operator()(Flag flag) const { return flag.is_set; }
  template <class T>
  Json operator()(const std::vector<T>& list) const {
    Json array = Json::array();
    for (const T& it : list) array.push_back((*this)(it));
    return array;
  }
  template <class T>
  Json operator()(const T& it) const {
    return it;
  }
};

// A value of any type is shown as the number that it looks like, else as a text.
Json entry_json(const ShapeEntry& its, const EntryState& entry) {
  if (entry.is_long) return "(too long to be shown)";
  if (its.value_type == ValueType::Object) return entry.text;
  if (its.typing != Typing::Any && its.value_type != ValueType::Number) {
    const auto value = parse_value(its.value_type, entry.text);
    return value ? std::visit(ToJson(), *value) : Json(entry.text);
  }
  if (const auto whole = parse_int(entry.text)) return *whole;
  if (const auto number = parse_double(entry.text)) return *number;
  return entry.text;
}

}  // namespace

GrootBoards::GrootBoards(Shape shape, std::vector<GrootBoardKeys> boards)
    : shape_(std::move(shape)), boards_(std::move(boards)), shown_(boards_.size()) {
  for (std::size_t number = 0; number < boards_.size(); ++number) {
    by_name_.emplace(boards_[number].name, number);
    if (number > 0) by_node_.emplace(boards_[number].node, number);
  }
  for (const NodeIndex node : synchronized_nodes(shape_)) {
    if (!shape_.nodes[node].is_pool()) show_synchronized(node);
  }
}

void GrootBoards::show_synchronized(NodeIndex node) {
  const bool is_relative = shape_.nodes[node].synchronization == Synchronization::Relative;
  show(node, is_relative ? "delta/" : "barrier/", What::Limit);
  for (const NodeIndex child : shape_.nodes[node].held()) {
    show(child, "progress/", What::Progress);
    show(child, "held/", What::Held);
  }
}

// Under its path within its subtree.
void GrootBoards::show(NodeIndex node, std::string_view prefix, What what) {
  std::string path = shape_.nodes[node].segment;
  std::size_t board = 0;
  for (NodeIndex at = node; shape_.nodes[at].parent && board == 0;) {
    at = *shape_.nodes[at].parent;
    const auto found = by_node_.find(at);
    if (found != by_node_.end()) board = found->second;
    if (board == 0) path.insert(0, shape_.nodes[at].segment + "/");
  }
  shown_[board].push_back({std::string(prefix) + path, node, what});
}

Json GrootBoards::shown(const Shown& it, const Snapshot& snapshot) const {
  const NodeView& node = snapshot.nodes[it.node];
  if (it.what == What::Progress) return node.progress;
  if (it.what == What::Held) return node.activity == Activity::Paused;
  // Where no barrier is left, a child may go to its end.
  return std::isfinite(node.limit) ? node.limit : 1.0;
}

Json GrootBoards::board(std::size_t number, const Snapshot& snapshot) const {
  const auto& slots = boards_[number].slots;
  Json json = Json::object();
  for (const Shown& it : shown_[number]) {
    if (!slots.contains(it.key)) json.add(it.key, shown(it, snapshot));
  }
  for (const auto& [key, slot] : slots) {
    const EntryState& entry = snapshot.entries[slot];
    if (entry.changed) json.add(key, entry_json(shape_.entries[slot], entry));
  }
  return json.members().empty() ? Json() : json;
}

// As the library says it: a board without entries is null, and so is an answer without boards. One
// who asks for a board inside gets the main tree's too.
std::string GrootBoards::dump(std::string_view names, const Snapshot& snapshot) const {
  std::set<std::size_t> asked;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(';'), names.size());
    const auto found = by_name_.find(names.substr(0, end));
    names.remove_prefix(std::min(end + 1, names.size()));
    if (found != by_name_.end()) asked.insert(found->second);
  }
  if (asked.empty()) return Json().message_pack();
  Json json = Json::object();
  for (const std::size_t number : asked) json.add(boards_[number].name, board(number, snapshot));
  const bool has_inner = *asked.rbegin() != 0;
  if (has_inner && !by_name_.contains(kMain)) json.add(std::string(kMain), board(0, snapshot));
  return json.message_pack();
}

}  // namespace lockstep::host
