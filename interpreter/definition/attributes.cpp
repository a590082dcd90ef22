#include "definition/attributes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/identifier.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/foreign_nodes.h"

namespace lockstep {
namespace {

std::string join_hints(const std::string& first, const std::string& second) {
  if (first.empty()) return second;
  return second.empty() ? first : first + "; " + second;
}

bool in_range(const Range& range, double number) {
  const bool above = range.min_excluded ? number > range.min : number >= range.min;
  return above && number <= range.max;
}

// The first number of a value that the range does not allow.
std::optional<double> out_of_range(const Range& range, const Value& value) {
  const auto outside = [&](double number) { return !in_range(range, number); };
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    const auto number = static_cast<double>(*integer);
    if (outside(number)) return number;
  } else if (const auto* number = std::get_if<double>(&value)) {
    if (outside(*number)) return *number;
  } else if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    const auto it = std::find_if(list->begin(), list->end(), outside);
    if (it != list->end()) return *it;
  }
  return std::nullopt;
}

constexpr auto kOwnAttributes =
    "attributes that begin with '_' belong to the language: _autoremap, _description; such a key "
    "cannot be remapped";

class AttributeChecker {
 public:
  AttributeChecker(const Document& document, const Reporter& report, const CheckedNode& node)
      : document_(document), report_(report), node_(node) {}

  void find_unknown(bool explicit_form) const {
    for (const Attribute& attribute : document_.attributes(node_.element)) {
      const std::string_view name = attribute.name;
      if (is_common_attribute(name) || (explicit_form && name == "ID") || parameter(name)) continue;
      if (report_.counted_only(Severity::Error)) continue;
      report_.at_attribute(node_.element, name,
                           fmt::format("'{}' has no parameter '{}'", node_.type->id, brief(name)),
                           unknown_hint(attribute));
    }
  }

  // The value of a parameter as written or by default; monostate when absent or wrong.
  Value constant(const Parameter& parameter) const {
    const Attribute* attribute = document_.find_attribute(node_.element, parameter.name);
    if (attribute == nullptr) return absent(parameter);
    const auto value = parse_value(parameter.type, attribute->value);
    // An argument that is wrong or missing is told already; $${ is a literal, and wrong here.
    const bool unknown = attribute->value.find("${") != std::string_view::npos;
    if (!value && unknown && report_.has_errors()) return {};
    if (!value) {
      report_.at_value(node_.element, parameter.name,
                       fmt::format("'{}' is not {}, which '{}' must be", brief(attribute->value),
                                   expected_text(parameter.type), parameter.name));
      return {};
    }
    if (const auto number = out_of_range(parameter.range, *value)) {
      report_.at_value(node_.element, parameter.name,
                       fmt::format("{} is outside the range of '{}'", *number, parameter.name),
                       "it must be " + range_text(parameter.range));
      return {};
    }
    if (!is_choice(parameter, *value)) return {};
    return *value;
  }

  const Attribute* attribute(const Parameter& parameter) const {
    return document_.find_attribute(node_.element, parameter.name);
  }

 private:
  // A leaf of a plugin only shares its name with a node of another library.
  std::string unknown_hint(const Attribute& attribute) const {
    const bool built_in = node_.type->binding == nullptr;
    std::string hint = foreign_attribute_hint(built_in ? node_.type->id : "", attribute);
    if (!hint.empty()) return hint;
    return join_hints(did_you_mean(attribute.name, names()), parameters_hint(*node_.type));
  }

  Value absent(const Parameter& parameter) const {
    if (parameter.default_text) return *parse_value(parameter.type, *parameter.default_text);
    if (parameter.required) {
      report_.at_element(
          node_.element,
          fmt::format("'{}' needs the parameter '{}'", node_.type->id, parameter.name),
          parameters_hint(*node_.type));
    }
    return {};
  }

  bool is_choice(const Parameter& parameter, const Value& value) const {
    if (parameter.choices.empty()) return true;
    const auto& word = std::get<std::string>(value);
    if (std::ranges::find(parameter.choices, word) != parameter.choices.end()) return true;
    report_.at_value(node_.element, parameter.name,
                     fmt::format("'{}' is not a value of '{}'", brief(word), parameter.name),
                     "it must be one of " + listed(parameter.choices));
    return false;
  }

  const Parameter* parameter(std::string_view name) const {
    for (const Parameter& it : node_.type->parameters) {
      if (it.name == name) return &it;
    }
    return nullptr;
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names{"name"};
    for (const Parameter& it : node_.type->parameters) names.push_back(it.name);
    return names;
  }

  const Document& document_;
  const Reporter& report_;
  const CheckedNode& node_;
};

void check_name(const Document& document, const Reporter& report, std::uint32_t element) {
  const Attribute* name = document.find_attribute(element, "name");
  if (name == nullptr) return;
  if (name->value.empty()) report.at_value(element, "name", "the name is empty");
  if (name->value.find('/') != std::string_view::npos) {
    report.at_value(element, "name", fmt::format("the name '{}' contains '/'", brief(name->value)),
                    "'/' separates the names in a node's path");
  }
}

void check_parameters(const Document& document, const Reporter& report,
                      const AttributeChecker& checker, CheckedNode& node, CheckedTrees& trees) {
  node.first = static_cast<std::uint32_t>(trees.values.size());
  bool all_good = true;
  for (const Parameter& parameter : node.type->parameters) {
    const Attribute* attribute = checker.attribute(parameter);
    if (attribute != nullptr && !key_of(attribute->value).empty()) {
      report.at_value(
          node.element, parameter.name,
          fmt::format("'{}' of '{}' cannot be a blackboard entry", parameter.name, node.type->id),
          "it is fixed when the tree is loaded: write a value, or ${name} with an <arg>");
      trees.values.emplace_back();
      all_good = false;
      continue;
    }
    trees.values.push_back(checker.constant(parameter));
    const bool absent = std::holds_alternative<std::monostate>(trees.values.back());
    all_good &= !absent || (attribute == nullptr && !parameter.required);
  }
  if (!all_good || node.type->rule == nullptr) return;
  const auto values = std::span(trees.values).subspan(node.first);
  const auto broken = node.type->rule(values, node.children);
  if (!broken) return;
  if (broken->parameter < 0) {
    report.at_element(node.element, broken->message, broken->hint);
    return;
  }
  const auto& name = node.type->parameters[static_cast<unsigned>(broken->parameter)].name;
  if (document.find_attribute(node.element, name) != nullptr) {
    report.at_value(node.element, name, broken->message, broken->hint);
  } else {
    report.at_element(node.element, broken->message, broken->hint);
  }
}

// What a port that is bound to an entry has until somebody writes that.
void set_default(const Parameter& port, CheckedPort& checked, CheckedTrees& trees) {
  if (!port.default_text) return;
  checked.value = static_cast<std::uint32_t>(trees.values.size());
  trees.values.push_back(*parse_value(port.type, *port.default_text));
}

void check_ports(const Reporter& report, const AttributeChecker& checker, CheckedNode& node,
                 CheckedTrees& trees) {
  node.first = static_cast<std::uint32_t>(trees.ports.size());
  for (const Parameter& port : node.type->parameters) {
    CheckedPort checked;
    const Attribute* attribute = checker.attribute(port);
    if (attribute != nullptr) checked.key = key_of(attribute->value);
    if (!checked.key.empty()) set_default(port, checked, trees);
    if (attribute != nullptr && checked.key.empty() && port.direction != Direction::Input) {
      report.at_value(
          node.element, port.name,
          fmt::format("the {} '{}' needs a blackboard entry",
                      port.direction == Direction::Output ? "output" : "inout", port.name),
          fmt::format("write {}=\"{{key}}\"", port.name));
    } else if (checked.key.empty()) {
      Value value = checker.constant(port);
      if (!std::holds_alternative<std::monostate>(value)) {
        checked.value = static_cast<std::uint32_t>(trees.values.size());
        trees.values.push_back(std::move(value));
      }
    } else if (!is_identifier(checked.key)) {
      report.at_value(node.element, port.name, fmt::format("'{}' is not a key", brief(checked.key)),
                      fmt::format("a key is {}", kIdentifierRule));
      checked.key = {};
    }
    trees.ports.push_back(checked);
  }
}

}  // namespace

std::string range_text(const Range& range) {
  const bool has_min = std::isfinite(range.min);
  const bool has_max = std::isfinite(range.max);
  if (!has_min && !has_max) return {};
  const std::string_view above = range.min_excluded ? "more than" : "at least";
  if (has_min && has_max && !range.min_excluded) {
    return fmt::format("from {} to {}", range.min, range.max);
  }
  if (has_min && has_max) return fmt::format("{} {}, at most {}", above, range.min, range.max);
  if (has_min) return fmt::format("{} {}", above, range.min);
  return fmt::format("at most {}", range.max);
}

bool is_common_attribute(std::string_view name) {
  return name == "name" || name == "_description";
}

std::string_view key_of(std::string_view text) {
  const bool braced = text.size() > 2 && text.front() == '{' && text.back() == '}';
  return braced ? text.substr(1, text.size() - 2) : std::string_view();
}

std::string parameters_hint(const NodeType& type) {
  if (type.parameters.empty()) return fmt::format("'{}' has no parameters", type.id);
  std::vector<std::string_view> names;
  for (const Parameter& parameter : type.parameters) names.push_back(parameter.name);
  return fmt::format("parameters of '{}': {}", type.id, listed(names));
}

void check_attributes(const Document& document, const Reporter& report, bool explicit_form,
                      CheckedNode& node, CheckedTrees& trees) {
  const AttributeChecker checker(document, report, node);
  check_name(document, report, node.element);
  checker.find_unknown(explicit_form);
  if (node.type->binding != nullptr) {
    check_ports(report, checker, node, trees);
  } else {
    check_parameters(document, report, checker, node, trees);
  }
}

void check_subtree_attributes(const Document& document, const Reporter& report, CheckedNode& node) {
  check_name(document, report, node.element);
  for (const Attribute& attribute : document.attributes(node.element)) {
    if (is_common_attribute(attribute.name)) continue;
    if (attribute.name == "ID") {
      node.subtree = attribute.value;
    } else if (attribute.name == "_autoremap") {
      if (!parse_value(ValueType::Bool, attribute.value)) {
        report.at_value(node.element, attribute.name,
                        fmt::format("'{}' is not true or false", brief(attribute.value)));
      }
    } else if (attribute.name.starts_with('_')) {
      if (report.counted_only(Severity::Error)) continue;
      const std::string hint = foreign_attribute_hint("SubTree", attribute);
      report.at_attribute(node.element, attribute.name,
                          fmt::format("'SubTree' has no attribute '{}'", brief(attribute.name)),
                          hint.empty() ? kOwnAttributes : hint);
    } else if (!is_identifier(attribute.name)) {
      report.at_attribute(node.element, attribute.name,
                          fmt::format("'{}' is not a key", brief(attribute.name)),
                          fmt::format("a key is {}", kIdentifierRule));
    } else if (const auto key = key_of(attribute.value); !key.empty() && !is_identifier(key)) {
      report.at_value(node.element, attribute.name, fmt::format("'{}' is not a key", brief(key)),
                      fmt::format("a key is {}", kIdentifierRule));
    }
  }
  if (node.subtree.empty()) {
    report.at_element(node.element, "'SubTree' needs the attribute 'ID'",
                      "write <SubTree ID=\"…\"/> with the ID of a BehaviorTree");
  }
}

}  // namespace lockstep
