#include "engine/bound_parameters.h"

#include <algorithm>

#include "base/blackboard/conversion.h"
#include "base/core/parameter_value.h"
#include "base/core/resource_set.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "engine/blackboard.h"
#include "engine/tree.h"

namespace lockstep::host {

BoundParameters::BoundParameters(const Tree& tree, const Blackboard& board)
    : tree_(tree),
      nodes_(tree.nodes.data()),
      board_(board),
      cells_(tree.cells.data()),
      numbers_(tree.numbers.data()) {
  if (tree.bound.empty()) return;
  own_.values.resize(tree.bound.size());
  for (std::size_t i = 0; i < own_.values.size(); ++i) {
    const std::size_t count = tree.labels[tree.bound[i].node].type->parameters.size();
    own_.values[i].values.resize(count);
    own_.values[i].seen.resize(count);
    own_.values[i].space.resize(count);
  }
  own_.cells = tree.cells;
  own_.numbers = tree.numbers;
  cells_ = own_.cells.data();
  numbers_ = own_.numbers.data();
}

void BoundParameters::reset() {
  for (Values& values : own_.values) values.known = false;
}

void BoundParameters::restore(const State& from) {
  if (own_.cells.empty()) return;
  own_ = from;
  cells_ = own_.cells.data();
  numbers_ = own_.numbers.data();
}

std::span<const std::string> BoundParameters::texts(NodeIndex node, unsigned index) const {
  const Cell& cell = cells_[tree_.nodes[node].params + index];
  const Value& constant = tree_.constants[static_cast<std::size_t>(cell.integer)];
  return std::get<std::vector<std::string>>(constant);
}

const std::string* BoundParameters::text(NodeIndex node, unsigned index) const {
  const auto place = static_cast<std::size_t>(cells_[tree_.nodes[node].params + index].integer);
  return place == 0 ? nullptr : &std::get<std::string>(tree_.constants[place - 1]);
}

std::span<const std::string> BoundParameters::pool_of(const BoundNode& node) const {
  return tree_.group(tree_.membership(node.node).group).resources;
}

bool BoundParameters::are_fixed(NodeIndex node) const {
  return are_constant(node) ||
         !tree_.bound[tree_.place_in_front(node, FrontCell::Bound)].may_change;
}

std::string BoundParameters::read(NodeIndex node) {
  if (are_constant(node)) return {};
  return read_bound(tree_.place_in_front(node, FrontCell::Bound));
}

std::string BoundParameters::read_bound(std::uint32_t place) {
  const BoundNode& node = tree_.bound[place];
  Values& values = own_.values[place];
  if (is_current(node, values)) return {};
  std::string wrong = take_values(node, values);
  values.known = wrong.empty();
  if (values.known) set_cells(node, values);
  return wrong;
}

bool BoundParameters::are_up_to_date(std::uint32_t place) const {
  const BoundNode& node = tree_.bound[place];
  const Values& read = own_.values[place];
  if (is_current(node, read)) return true;
  Values now = read;
  return take_values(node, now).empty() && now.values == read.values;
}

void BoundParameters::set(std::uint32_t place, const std::vector<Value>& values) {
  Values& read = own_.values[place];
  read.values = values;
  read.known = false;
  set_cells(tree_.bound[place], read);
}

bool BoundParameters::is_current(const BoundNode& node, const Values& values) const {
  if (!values.known) return false;
  for (std::size_t i = 0; i < values.seen.size(); ++i) {
    const std::uint32_t slot = tree_.ports[node.first_port + i].slot;
    if (slot == PortBinding::kUnbound) continue;
    const Entry& entry = board_.entries[slot];
    // One that is not strict may have been removed and made again.
    if (entry.typing != Typing::Strict || entry.writes() != values.seen[i]) return false;
  }
  return true;
}

std::string BoundParameters::take_values(const BoundNode& node, Values& values) const {
  const NodeType& type = node.kind->type;
  std::optional<unsigned> absent;  // the first that only an entry gives, which has no value
  for (unsigned i = 0; i < values.values.size(); ++i) {
    if (type.parameters[i].direction == Direction::Output) continue;
    const PortBinding& port = tree_.ports[node.first_port + i];
    const Entry* entry = port.slot == PortBinding::kUnbound ? nullptr : &board_.entries[port.slot];
    const bool written = entry != nullptr && entry->has_value();
    if (entry != nullptr) values.seen[i] = entry->writes();
    if (written) {
      if (!take_value(type.parameters[i], entry->value(), values.values[i])) {
        return unreadable(node, i);
      }
      if (const auto why = refuse_value(type.parameters[i], values.values[i])) {
        return refusal(node, i, *why);
      }
      if (const auto why = refuse_resources(node, type.parameters[i], values.values[i])) {
        return refusal(node, i, *why);
      }
    } else if (port.constant != PortBinding::kUnbound) {
      values.values[i] = tree_.constants[port.constant];
    } else {
      values.values[i] = {};
      if (entry == nullptr) continue;
      if (type.parameters[i].required) return missing(node, i);
      if (!absent) absent = i;
    }
  }
  if (type.rule == nullptr) return {};
  const auto broken =
      type.rule({.values = values.values, .children = tree_.nodes[node.node].children});
  if (!broken) return {};
  // Where nothing is wrong with one parameter, that is why one is missing.
  if (broken->parameter < 0 && absent) return missing(node, *absent);
  return refusal(node, static_cast<unsigned>(broken->parameter), *broken);
}

std::string BoundParameters::missing(const BoundNode& node, unsigned parameter) const {
  std::string text = "'";  // g++ 12 warns falsely of "'" + std::string(…)
  text.append(node.kind->type.parameters[parameter].name)
      .append("' has no value: nothing has written the entry '{");
  return text.append(tree_.slots[tree_.ports[node.first_port + parameter].slot].name).append("}'");
}

// As a value of the parameter's type. False: it has none.
bool BoundParameters::take_value(const Parameter& parameter, const Value& from, Value& value) {
  if (holds(from, parameter.type)) {
    value = from;
    return true;
  }
  auto converted = convert_value(from, parameter.type, parameter.object);
  if (converted) value = std::move(*converted);
  return converted.has_value();
}

std::string BoundParameters::unreadable(const BoundNode& node, unsigned parameter) const {
  const Parameter& it = node.kind->type.parameters[parameter];
  return refusal(node, parameter,
                 {.message = "expected " + expected_text(it.type, it.object), .hint = {}});
}

// Refuses a resource that the pool of the member does not have.
std::optional<RuleBreak> BoundParameters::refuse_resources(const BoundNode& node,
                                                           const Parameter& parameter,
                                                           const Value& value) const {
  if (!parameter.of_pool) return std::nullopt;
  const std::span<const std::string> names = pool_of(node);
  const std::string_view unknown = resource_list(std::get<std::string>(value), names).unknown;
  if (unknown.empty()) return std::nullopt;
  const std::vector<std::string_view> known(names.begin(), names.end());
  return RuleBreak{.message = "the pool '" +
                              std::string(tree_.labels[tree_.membership(node.node).group].name) +
                              "' has no resource '" + brief(unknown) + "'",
                   .hint = suggest(unknown, known, "its resources")};
}

std::string BoundParameters::refusal(const BoundNode& node, unsigned parameter,
                                     const RuleBreak& why) const {
  const NodeType& type = node.kind->type;
  if (parameter < type.parameters.size()) {
    const std::uint32_t slot = tree_.ports[node.first_port + parameter].slot;
    if (slot != PortBinding::kUnbound) {
      return refusal_text(why, type.parameters[parameter].name, board_.entries[slot].value(),
                          tree_.slots[slot].name);
    }
  }
  return why.hint.empty() ? why.message : why.message + "; " + why.hint;
}

void BoundParameters::set_cells(const BoundNode& node, Values& values) {
  Cell* const cells = own_.cells.data() + tree_.nodes[node.node].params;
  const auto& parameters = node.kind->type.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].is_script || parameters[i].constant) continue;
    const auto* list = std::get_if<std::vector<double>>(&values.values[i]);
    if (parameters[i].of_pool) {
      const auto& names = std::get<std::string>(values.values[i]);
      set_list(cells[i], values.space[i], resource_list(names, pool_of(node)).request());
    } else if (list == nullptr) {
      cells[i] = scalar_cell(parameters[i], values.values[i]);
    } else {
      set_list(cells[i], values.space[i], *list);
    }
  }
}

// A list that has outgrown its place gets a new one of twice the size at the end.
void BoundParameters::set_list(Cell& cell, std::uint32_t& space, std::span<const double> list) {
  const auto count = static_cast<std::uint32_t>(list.size());
  if (count > space) {
    space = std::max(count, 2 * space);
    cell.list.first = static_cast<std::uint32_t>(own_.numbers.size());
    own_.numbers.resize(own_.numbers.size() + space);
    numbers_ = own_.numbers.data();
  }
  cell.list.count = count;
  std::ranges::copy(list, own_.numbers.begin() + cell.list.first);
}

}  // namespace lockstep::host
