#include "definition/attributes.h"

#include <fmt/format.h>

#include <span>

#include "core/identifier.h"
#include "core/parameter_value.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/foreign_nodes.h"

namespace lockstep {
namespace {

std::string join_hints(const std::string& first, const std::string& second) {
  if (first.empty()) return second;
  return second.empty() ? first : first + "; " + second;
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
    if (const auto refused = refuse_value(parameter, *value)) {
      report_.at_value(node_.element, parameter.name, refused->message, refused->hint);
      return {};
    }
    return *value;
  }

  const Attribute* attribute(const Parameter& parameter) const {
    return document_.find_attribute(node_.element, parameter.name);
  }

 private:
  // A leaf of a plugin only shares its name with a node of another library.
  std::string unknown_hint(const Attribute& attribute) const {
    const bool built_in = node_.type->leaf == nullptr;
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

// What follows from values that entries give follows during the run, so it is not filled in here.
void check_rule(const Document& document, const Reporter& report, const CheckedNode& node,
                std::span<const CheckedPort> ports, std::span<Value> values) {
  ParameterValues parameters{.values = values, .children = node.children};
  std::vector<Value> copy;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (!ports[i].key.empty()) parameters.from_entry |= std::uint64_t{1} << i;
  }
  if (parameters.from_entry != 0) {
    copy.assign(values.begin(), values.end());
    parameters.values = copy;
  }
  const auto broken = node.type->rule(parameters);
  if (!broken) return;
  if (broken->parameter >= 0) {
    const auto& name = node.type->parameters[static_cast<unsigned>(broken->parameter)].name;
    if (document.find_attribute(node.element, name) != nullptr) {
      report.at_value(node.element, name, broken->message, broken->hint);
      return;
    }
  }
  report.at_element(node.element, broken->message, broken->hint);
}

// The key of {key}; "" when that is an error, which is reported.
std::string_view checked_key(const Reporter& report, const CheckedNode& node,
                             const Parameter& parameter, std::string_view key) {
  if (parameter.constant) {
    report.at_value(
        node.element, parameter.name,
        fmt::format("'{}' of '{}' cannot be a blackboard entry", parameter.name, node.type->id),
        "it is fixed when the tree is loaded: write a value, or ${name} with an <arg>");
    return {};
  }
  if (is_identifier(key)) return key;
  report.at_value(node.element, parameter.name, fmt::format("'{}' is not a key", brief(key)),
                  fmt::format("a key is {}", kIdentifierRule));
  return {};
}

// What one parameter is: a value, a key with its default, or nothing. False after an error.
bool check_parameter(const Reporter& report, const AttributeChecker& checker,
                     const CheckedNode& node, const Parameter& parameter, CheckedPort& port,
                     Value& value) {
  const Attribute* attribute = checker.attribute(parameter);
  const auto key = attribute == nullptr ? std::string_view() : key_of(attribute->value);
  if (!key.empty()) {
    port.key = checked_key(report, node, parameter, key);
    if (parameter.default_text) value = *parse_value(parameter.type, *parameter.default_text);
    return !port.key.empty();
  }
  if (attribute != nullptr && parameter.direction != Direction::Input) {
    report.at_value(
        node.element, parameter.name,
        fmt::format("the {} '{}' needs a blackboard entry",
                    parameter.direction == Direction::Output ? "output" : "inout", parameter.name),
        fmt::format("write {}=\"{{key}}\"", parameter.name));
    return false;
  }
  value = checker.constant(parameter);
  const bool absent = std::holds_alternative<std::monostate>(value);
  return !absent || (attribute == nullptr && !parameter.required);
}

void check_parameters(const Document& document, const Reporter& report,
                      const AttributeChecker& checker, CheckedNode& node, CheckedTrees& trees) {
  const auto& parameters = node.type->parameters;
  const std::size_t first_value = trees.values.size();
  node.first = static_cast<std::uint32_t>(trees.ports.size());
  trees.ports.resize(node.first + parameters.size());
  trees.values.resize(first_value + parameters.size());
  const auto ports = std::span(trees.ports).subspan(node.first);
  const auto values = std::span(trees.values).subspan(first_value);
  bool good = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    good &= check_parameter(report, checker, node, parameters[i], ports[i], values[i]);
  }
  if (good && node.type->rule != nullptr) check_rule(document, report, node, ports, values);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (std::holds_alternative<std::monostate>(values[i])) continue;
    ports[i].value = static_cast<std::uint32_t>(first_value + i);
  }
}

}  // namespace

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
  check_parameters(document, report, checker, node, trees);
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
