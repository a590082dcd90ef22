#include "definition/check/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/identifier.h"
#include "core/parameter_value.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/check/foreign_hints.h"
#include "definition/check/scripts.h"

namespace lockstep::host {
namespace {

std::string join_hints(const std::string& first, const std::string& second) {
  if (first.empty()) return second;
  return second.empty() ? first : first + "; " + second;
}

constexpr auto kOwnAttributes =
    "attributes that begin with '_' are reserved (_autoremap, _description), so such a key "
    "cannot be remapped";

// What every node may have.
bool is_common_attribute(std::string_view name) {
  return name == "name" || name == "_description";
}

// "key" when `text` is "{key}", else "".
std::string_view key_of(std::string_view text) {
  const bool braced = text.size() > 2 && text.front() == '{' && text.back() == '}';
  return braced ? text.substr(1, text.size() - 2) : std::string_view();
}

class AttributeChecker {
 public:
  AttributeChecker(const NodeElement& element, const Reporter& report, const CheckedNode& node,
                   const LanguageRules& rules)
      : element_(element), report_(report), node_(node), rules_(rules) {}

  void find_unknown() const {
    for (const Attribute& attribute : element_.attributes) {
      const std::string_view name = attribute.name;
      const bool names_type = element_.is_explicit && name == "ID";
      if (is_common_attribute(name) || names_type || parameter(name) || is_hook(name)) continue;
      if (report_.counted_only(Severity::Error)) continue;
      report_.at(attribute.place,
                 fmt::format("'{}' has no parameter '{}'", node_.type->id, brief(name)),
                 unknown_hint(attribute));
    }
  }

  // The value of a parameter as written in `attribute` or by default; monostate when absent or
  // wrong.
  Value constant(const Parameter& parameter, const Attribute* attribute) const {
    if (attribute == nullptr) return absent(parameter);
    auto value = parse_value(parameter.type, parameter.object, attribute->value);
    // A wrong or missing argument was already reported; $${ is a literal, and wrong here.
    const bool unknown = attribute->value.find("${") != std::string_view::npos;
    if (!value && unknown && report_.has_errors()) return {};
    if (!value) {
      report_no_value(*attribute, report_, *node_.type, parameter);
      return {};
    }
    if (const auto refused = refuse_value(parameter, *value)) {
      report_refusal(*attribute, report_, *node_.type, parameter, *refused);
      return {};
    }
    // Moved: g++ 12 destroys the result when it cannot be copied, though there is none.
    return *std::move(value);
  }

 private:
  // A leaf of a plugin only shares its name with a node of another library.
  std::string_view foreign_tag() const { return node_.type->leaf == nullptr ? node_.type->id : ""; }

  std::string unknown_hint(const Attribute& attribute) const {
    std::string hint = foreign_attribute_hint(foreign_tag(), attribute);
    if (!hint.empty()) return hint;
    return join_hints(did_you_mean(attribute.name, names()), parameters_hint(*node_.type));
  }

  Value absent(const Parameter& parameter) const {
    if (parameter.default_text) return *parse_value(parameter.type, *parameter.default_text);
    if (parameter.required && !is_misspelled(parameter)) {
      report_.at(element_.place,
                 fmt::format("'{}' needs the parameter '{}'", node_.type->id, parameter.name),
                 parameters_hint(*node_.type));
    }
    return {};
  }

  // An unknown attribute means this parameter: one error is enough.
  bool is_misspelled(const Parameter& missing) const {
    return std::ranges::any_of(element_.attributes, [&](const Attribute& attribute) {
      if (is_common_attribute(attribute.name) || parameter(attribute.name) ||
          is_hook(attribute.name)) {
        return false;
      }
      return foreign_attribute_name(foreign_tag(), attribute.name) == missing.name ||
             nearest(attribute.name, names()) == missing.name;
    });
  }

  const Parameter* parameter(std::string_view name) const {
    for (const Parameter& it : node_.type->parameters) {
      if (it.name == name) return &it;
    }
    return nullptr;
  }

  // What is declared beside the trees is never ticked.
  bool has_hooks() const { return node_.type->category != NodeCategory::Group; }
  bool is_hook(std::string_view name) const {
    return has_hooks() && hook_named(name, rules_).has_value();
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names{"name"};
    for (const Parameter& it : node_.type->parameters) names.push_back(it.name);
    if (!has_hooks()) return names;
    names.insert(names.end(), rules_.hooks.begin(), rules_.hooks.end());
    return names;
  }

  const NodeElement& element_;
  const Reporter& report_;
  const CheckedNode& node_;
  const LanguageRules& rules_;
};

void check_name(const NodeElement& element, const Reporter& report) {
  const Attribute* name = find_attribute(element.attributes, "name");
  if (name == nullptr) return;
  if (name->value.empty()) report.at_value(name->place, "the name is empty");
  if (name->value.find('/') != std::string_view::npos) {
    report.at_value(name->place, fmt::format("the name '{}' contains '/'", brief(name->value)),
                    "'/' separates the names in a node's path");
  }
}

// The key of {key}; "" when that is an error, which is reported.
std::string_view checked_key(const Reporter& report, const NodeType& type,
                             const Parameter& parameter, Place place, std::string_view key) {
  if (parameter.constant) {
    report.at_value(
        place, fmt::format("'{}' of '{}' cannot be a blackboard entry", parameter.name, type.id),
        "it is fixed when the tree is loaded: write a value, or ${name} with an <arg>");
    return {};
  }
  if (is_identifier(key)) return key;
  report.at_value(place, fmt::format("'{}' is not a key", brief(key)),
                  fmt::format("a key is {}", kIdentifierRule));
  return {};
}

// A stand-in for a node that no plugin has: how that uses the port is not known.
bool is_guessed(const NodeType& type, const Parameter& parameter) {
  return type.mock != nullptr && parameter.is_generic;
}

// What one parameter is: a value, a key with its default, or nothing. False after an error.
bool check_parameter(const NodeElement& element, const Reporter& report,
                     const AttributeChecker& checker, const NodeType& type,
                     const Parameter& parameter, CheckedPort& port, Value& value) {
  const Attribute* attribute = find_attribute(element.attributes, parameter.name);
  const auto key = attribute == nullptr ? std::string_view() : key_of(attribute->value);
  if (!key.empty()) {
    port.place = attribute->place;
    port.key = checked_key(report, type, parameter, attribute->place, key);
    if (parameter.default_text) value = *parse_value(parameter.type, *parameter.default_text);
    return !port.key.empty();
  }
  if (attribute == nullptr && !parameter.default_key.empty()) {
    port.place = element.place;
    port.key = parameter.default_key;
    return true;
  }
  if (attribute != nullptr && !parameter.group.empty()) port.place = attribute->place;
  if (attribute != nullptr && parameter.direction != Direction::Input &&
      !is_guessed(type, parameter)) {
    report.at_value(
        attribute->place,
        fmt::format("the {} '{}' needs a blackboard entry",
                    parameter.direction == Direction::Output ? "output" : "inout", parameter.name),
        fmt::format("write {}=\"{{key}}\"", parameter.name));
    return false;
  }
  value = checker.constant(parameter, attribute);
  const bool absent = std::holds_alternative<NoValue>(value);
  return !absent || (attribute == nullptr && !parameter.required);
}

void check_parameters(const NodeElement& element, const Reporter& report,
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
    const Attribute* script =
        parameters[i].is_script ? find_attribute(element.attributes, parameters[i].name) : nullptr;
    good &= script != nullptr
                ? read_script(*script, report, EmptyScript::IsRefused, ports[i], trees)
                : check_parameter(element, report, checker, *node.type, parameters[i], ports[i],
                                  values[i]);
  }
  if (good) check_rule(element, report, node, ports, values);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (std::holds_alternative<NoValue>(values[i])) continue;
    ports[i].value = static_cast<std::uint32_t>(first_value + i);
  }
}

}  // namespace

void report_no_value(const Attribute& attribute, const Reporter& report, const NodeType& type,
                     const Parameter& parameter) {
  const bool is_list = parameter.type == ValueType::DoubleList;
  const ListErrors errors = is_list ? list_errors(type, parameter, attribute.value) : ListErrors();
  const std::size_t others = errors.no_numbers.size();
  report.at_value(attribute.place,
                  fmt::format("'{}' is not {}, which '{}' must be", brief(attribute.value),
                              expected_text(parameter.type, parameter.object), parameter.name),
                  others == 0 ? why_no_object(parameter.object, attribute.value)
                              : fmt::format("no {}: {}", others == 1 ? "number" : "numbers",
                                            listed(errors.no_numbers)));
  for (const RuleBreak& it : errors.refused) {
    report.at_value(attribute.place, it.message, it.hint);
  }
}

void report_refusal(const Attribute& attribute, const Reporter& report, const NodeType& type,
                    const Parameter& parameter, const RuleBreak& refused) {
  if (parameter.type != ValueType::DoubleList) {
    return report.at_value(attribute.place, refused.message, refused.hint);
  }
  for (const RuleBreak& it : list_errors(type, parameter, attribute.value).refused) {
    report.at_value(attribute.place, it.message, it.hint);
  }
}

void check_rule(const NodeElement& element, const Reporter& report, const CheckedNode& node,
                std::span<const CheckedPort> ports, std::span<Value> values) {
  if (node.type->rule == nullptr) return;
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
    if (const Attribute* attribute = find_attribute(element.attributes, name)) {
      report.at_value(attribute->place, broken->message, broken->hint);
      return;
    }
  }
  report.at(element.place, broken->message, broken->hint);
}

std::string parameters_hint(const NodeType& type) {
  if (type.parameters.empty()) return fmt::format("'{}' has no parameters", type.id);
  std::vector<std::string_view> names;
  for (const Parameter& parameter : type.parameters) names.push_back(parameter.name);
  return fmt::format("parameters of '{}': {}", type.id, listed(names));
}

void check_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                      CheckedTrees& trees) {
  const AttributeChecker checker(element, report, node, *trees.rules);
  check_name(element, report);
  checker.find_unknown();
  check_parameters(element, report, checker, node, trees);
  if (node.type->category != NodeCategory::Group) check_hooks(element, report, node, trees);
}

void check_subtree_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                              CheckedSubTree& subtree, CheckedTrees& trees) {
  check_name(element, report);
  check_hooks(element, report, node, trees);
  subtree.first = static_cast<std::uint32_t>(trees.remappings.size());
  for (const auto& [name, value, place] : element.attributes) {
    if (is_common_attribute(name) || hook_named(name, *trees.rules)) continue;
    if (name == "ID") {
      subtree.id = value;
      subtree.place = place;
    } else if (name == "_autoremap") {
      const auto autoremap = parse_value(ValueType::Bool, value);
      subtree.autoremap = autoremap == Value(true);
      if (autoremap) continue;
      report.at_value(place, fmt::format("'{}' is not true or false", brief(value)));
    } else if (name.starts_with('_')) {
      if (report.counted_only(Severity::Error)) continue;
      const std::string hint = foreign_attribute_hint("SubTree", {name, value});
      report.at(place, fmt::format("'SubTree' has no attribute '{}'", brief(name)),
                hint.empty() ? kOwnAttributes : hint);
    } else if (!is_identifier(name)) {
      report.at(place, fmt::format("'{}' is not a key", brief(name)),
                fmt::format("a key is {}", kIdentifierRule));
    } else {
      const auto key = key_of(value);
      trees.remappings.push_back({name, key.empty() ? value : key, !key.empty(), place});
      if (key.empty() || is_identifier(key)) continue;
      report.at_value(place, fmt::format("'{}' is not a key", brief(key)),
                      fmt::format("a key is {}", kIdentifierRule));
    }
  }
  subtree.remappings = static_cast<std::uint32_t>(trees.remappings.size()) - subtree.first;
  if (subtree.id.empty()) {
    report.at(element.place, "'SubTree' needs the attribute 'ID'",
              "write <SubTree ID=\"…\"/> with the ID of a BehaviorTree");
  }
}

void keep_written(const NodeElement& element, CheckedNode& node, CheckedTrees& trees) {
  const auto first = static_cast<std::uint32_t>(trees.written.size());
  for (const Attribute& attribute : element.attributes) {
    const bool names_type = element.is_explicit && attribute.name == "ID";
    if (attribute.name == "name" || names_type) continue;
    trees.written.push_back({attribute.name, attribute.value, false, attribute.place});
  }
  if (trees.written.size() == first) return;
  trees.written.back().is_last = true;
  node.written = first;
}

}  // namespace lockstep::host
