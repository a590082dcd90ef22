#include "tree/check/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/core/element_types.h"
#include "base/core/identifier.h"
#include "base/core/parameter_value.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "tree/check/foreign_hints.h"
#include "tree/check/scripts.h"

namespace lockstep::host {
namespace {

constexpr auto kOwnAttributes =
    "attributes that begin with '_' are reserved (_autoremap, _description), so such a key "
    "cannot be remapped";

// "key" when `text` is "{key}", else "".
std::string_view key_of(std::string_view text) {
  const bool braced = text.size() > 2 && text.front() == '{' && text.back() == '}';
  return braced ? text.substr(1, text.size() - 2) : std::string_view();
}

void check_name(const Attribute& name, const Reporter& report) {
  if (name.value.empty()) report.at_value("bad-name"_code, name.place, "the name is empty");
  if (name.value.find('/') != std::string_view::npos) {
    report.at_value("bad-name"_code, name.place,
                    fmt::format("the name '{}' contains '/'", brief(name.value)),
                    "'/' separates the names in a node's path");
  }
}

// The key of {key}; "" when that is an error, which is reported.
std::string_view checked_key(const Reporter& report, const NodeType& type,
                             const Parameter& parameter, Place place, std::string_view key) {
  if (parameter.constant) {
    report.at_value(
        "fixed-parameter"_code, place,
        fmt::format("'{}' of '{}' cannot be a blackboard entry", parameter.name, type.id),
        "it is fixed when the tree is loaded: write a value, or ${name} with an <arg>");
    return {};
  }
  if (is_identifier(key)) return key;
  report.at_value("bad-key"_code, place, fmt::format("'{}' is not a key", brief(key)),
                  fmt::format("a key is {}", kIdentifierRule));
  return {};
}

// A stand-in for a node that no plugin has: how that uses the port is not known.
bool is_guessed(const NodeType& type, const Parameter& parameter) {
  return type.mock != nullptr && parameter.is_generic;
}

class AttributeChecker {
 public:
  AttributeChecker(const NodeElement& element, const Reporter& report, AttributeLayout& layout,
                   CheckedNode& node, CheckedTrees& trees)
      : element_(element),
        report_(report),
        layout_(layout),
        node_(node),
        trees_(trees),
        rules_(*trees.rules) {}

  void check() {
    if (layout_.name != AttributeLayout::kNone) {
      check_name(element_.attributes[layout_.name], report_);
    }
    if (layout_.has_unknown) find_unknown();
    check_parameters();
    if (layout_.has_hooks) check_hooks(element_, report_, node_, trees_);
    if (layout_.has_at_cut) check_at_cut(element_, report_, node_, rules_);
  }

 private:
  void find_unknown() const {
    for (const Attribute& attribute : element_.attributes) {
      if (!is_unknown(attribute.name) || report_.counted_only(Severity::Error)) continue;
      report_.at("unknown-port"_code, attribute.place,
                 fmt::format("'{}' has no parameter '{}'", node_.type->id, brief(attribute.name)),
                 unknown_hint(attribute));
    }
  }

  bool is_unknown(std::string_view name) const {
    const bool names_type = element_.is_explicit && name == "ID";
    return !is_common_attribute(name) && !names_type && parameter(name) == nullptr &&
           !is_hook(name) && !matches_any(node_.type->more_parameters, name);
  }

  void check_parameters() {
    node_.first = static_cast<std::uint32_t>(trees_.ports.size());
    trees_.ports.insert(trees_.ports.end(), layout_.ports.begin(), layout_.ports.end());
    bool good = true;
    for (const AttributeLayout::Given given : layout_.given) good &= check_parameter(given);
    if (good && node_.type->rule != nullptr) apply_rule();
  }

  // Reads a parameter as a value, a key with its default, or a script. Returns false after an
  // error.
  bool check_parameter(AttributeLayout::Given given) {
    const Parameter& parameter = node_.type->parameters[given.parameter];
    CheckedPort& port = trees_.ports[node_.first + given.parameter];
    if (given.attribute == AttributeLayout::kNone) return check_absent(parameter, port);
    const Attribute& attribute = element_.attributes[given.attribute];
    if (parameter.is_script) {
      return read_script(attribute, report_, parameter, EmptyScript::IsRefused, port, trees_);
    }
    const auto key = key_of(attribute.value);
    if (key.empty()) return check_value(attribute, given.parameter, port);
    port.place = attribute.place;
    port.key = checked_key(report_, *node_.type, parameter, attribute.place, key);
    port.value = layout_.defaults[given.parameter];
    return !port.key.empty();
  }

  // Texts that differ mostly differ in their last letter, which takes no call to see.
  static bool is_same(std::string_view one, std::string_view other) {
    if (one.size() != other.size()) return false;
    return one.empty() || (one.back() == other.back() && one == other);
  }

  // It is left out, and has no default.
  bool check_absent(const Parameter& parameter, CheckedPort& port) const {
    if (parameter.default_key.empty()) {
      missing(parameter);
      return false;
    }
    port.place = element_.place;
    port.key = parameter.default_key;
    return true;
  }

  bool check_value(const Attribute& attribute, std::uint32_t place, CheckedPort& port) {
    const Parameter& parameter = node_.type->parameters[place];
    if (!parameter.group.empty()) port.place = attribute.place;
    if (parameter.direction != Direction::Input && !is_guessed(*node_.type, parameter)) {
      report_.at_value("needs-entry"_code, attribute.place,
                       fmt::format("the {} '{}' needs a blackboard entry",
                                   parameter.direction == Direction::Output ? "output" : "inout",
                                   parameter.name),
                       fmt::format("write {}=\"{{key}}\"", parameter.name));
      return false;
    }
    AttributeLayout::Constant& last = layout_.last[place];
    if (last.value == AttributeLayout::kNone || !is_same(last.text, attribute.value)) {
      auto value = constant(parameter, attribute);
      if (!value) return false;
      last = {attribute.value, static_cast<std::uint32_t>(trees_.values.size())};
      trees_.values.push_back(*std::move(value));
    }
    port.value = last.value;
    return true;
  }

  // The rule may fill in values, so the node gets its own ones, side by side.
  void apply_rule() {
    const auto& parameters = node_.type->parameters;
    const std::size_t first = trees_.values.size();
    trees_.values.resize(first + parameters.size());
    const auto ports = std::span(trees_.ports).subspan(node_.first, parameters.size());
    const auto values = std::span(trees_.values).subspan(first);
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (parameters[i].is_script || ports[i].value == Port::kNone) continue;
      values[i] = trees_.values[ports[i].value];
    }
    check_rule(element_, report_, node_, ports, values);
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (std::holds_alternative<NoValue>(values[i])) continue;
      ports[i].value = static_cast<std::uint32_t>(first + i);
    }
  }

  // The value that is written in `attribute`; nothing when it is wrong.
  std::optional<Value> constant(const Parameter& parameter, const Attribute& attribute) const {
    auto value = parse_value(parameter.type, parameter.object, attribute.value);
    if (!value) {
      // A wrong or missing argument was already reported; $${ is a literal, and wrong here.
      const bool unknown = attribute.value.find("${") != std::string_view::npos;
      if (!unknown || !report_.has_errors()) {
        report_no_value(attribute, report_, *node_.type, parameter);
      }
      return value;
    }
    if (const auto refused = refuse_value(parameter, *value)) {
      report_refusal(attribute, report_, *node_.type, parameter, *refused);
      value.reset();
    }
    return value;
  }

  void missing(const Parameter& parameter) const {
    if (is_misspelled(parameter)) return;
    report_.at("missing-port"_code, element_.place,
               fmt::format("'{}' needs the parameter '{}'", node_.type->id, parameter.name),
               parameters_hint(*node_.type));
  }

  // A leaf of a plugin only shares its name with a node of another library.
  std::string_view foreign_tag() const { return node_.type->leaf == nullptr ? node_.type->id : ""; }

  std::string unknown_hint(const Attribute& attribute) const {
    std::string hint = foreign_attribute_hint(foreign_tag(), attribute);
    if (!hint.empty()) return hint;
    return join_hints(did_you_mean(attribute.name, names()), parameters_hint(*node_.type));
  }

  // An unknown attribute means this parameter: one error is enough.
  bool is_misspelled(const Parameter& missing) const {
    return std::ranges::any_of(element_.attributes, [&](const Attribute& attribute) {
      return is_unknown(attribute.name) &&
             (foreign_attribute_name(foreign_tag(), attribute.name) == missing.name ||
              nearest(attribute.name, names()) == missing.name);
    });
  }

  const Parameter* parameter(std::string_view name) const {
    for (const Parameter& it : node_.type->parameters) {
      if (it.name == name) return &it;
    }
    return nullptr;
  }

  // Nodes that are declared beside the trees are never ticked.
  bool has_hooks() const { return node_.type->category != NodeCategory::Group; }
  bool is_hook(std::string_view name) const {
    return (has_hooks() && hook_named(name, rules_).has_value()) || is_at_cut(name);
  }
  bool is_at_cut(std::string_view name) const {
    return node_.type->category == NodeCategory::Action && is_of_actions(name, rules_);
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names{"name"};
    for (const Parameter& it : node_.type->parameters) names.push_back(it.name);
    if (!has_hooks()) return names;
    names.insert(names.end(), rules_.hooks.begin(), rules_.hooks.end());
    if (is_at_cut(rules_.commit)) names.insert(names.end(), {rules_.on_resume, rules_.commit});
    return names;
  }

  const NodeElement& element_;
  const Reporter& report_;
  AttributeLayout& layout_;
  CheckedNode& node_;
  CheckedTrees& trees_;
  const LanguageRules& rules_;
};

}  // namespace

void report_no_value(const Attribute& attribute, const Reporter& report, const NodeType& type,
                     const Parameter& parameter) {
  const bool is_list = parameter.type == ValueType::DoubleList;
  const ListErrors errors = is_list ? list_errors(type, parameter, attribute.value) : ListErrors();
  const std::size_t others = errors.no_numbers.size();
  report.at_value("bad-value"_code, attribute.place,
                  fmt::format("'{}' is not {}, which '{}' must be", brief(attribute.value),
                              expected_text(parameter.type, parameter.object), parameter.name),
                  others == 0 ? why_no_object(parameter.object, attribute.value)
                              : fmt::format("no {}: {}", others == 1 ? "number" : "numbers",
                                            listed(errors.no_numbers)));
  for (const RuleBreak& it : errors.refused) {
    report.at_value("bad-value"_code, attribute.place, it.message, it.hint);
  }
}

void report_refusal(const Attribute& attribute, const Reporter& report, const NodeType& type,
                    const Parameter& parameter, const RuleBreak& refused) {
  if (parameter.type != ValueType::DoubleList) {
    return report.at_value("bad-value"_code, attribute.place, refused.message, refused.hint);
  }
  for (const RuleBreak& it : list_errors(type, parameter, attribute.value).refused) {
    report.at_value("bad-value"_code, attribute.place, it.message, it.hint);
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
      report.at_value("bad-value"_code, attribute->place, broken->message, broken->hint);
      return;
    }
  }
  report.at("bad-value"_code, element.place, broken->message, broken->hint);
}

std::string parameters_hint(const NodeType& type) {
  if (type.parameters.empty()) return fmt::format("'{}' has no parameters", type.id);
  std::vector<std::string_view> names;
  for (const Parameter& parameter : type.parameters) names.push_back(parameter.name);
  return fmt::format("parameters of '{}': {}", type.id, listed(names));
}

void check_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                      AttributeLayouts& layouts, CheckedTrees& trees) {
  AttributeLayout& layout = layouts.of(element, *node.type, trees);
  AttributeChecker(element, report, layout, node, trees).check();
}

void check_subtree_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                              CheckedSubTree& subtree, CheckedTrees& trees) {
  if (const Attribute* named = find_attribute(element.attributes, "name")) {
    check_name(*named, report);
  }
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
      report.at_value("bad-value"_code, place,
                      fmt::format("'{}' is not true or false", brief(value)));
    } else if (name.starts_with('_')) {
      if (report.counted_only(Severity::Error)) continue;
      const std::string hint = foreign_attribute_hint("SubTree", {name, value});
      report.at("unknown-attribute"_code, place,
                fmt::format("'SubTree' has no attribute '{}'", brief(name)),
                hint.empty() ? kOwnAttributes : hint);
    } else if (!is_identifier(name)) {
      report.at("bad-key"_code, place, fmt::format("'{}' is not a key", brief(name)),
                fmt::format("a key is {}", kIdentifierRule));
    } else {
      const auto key = key_of(value);
      trees.remappings.push_back({name, key.empty() ? value : key, !key.empty(), place});
      if (key.empty() || is_identifier(key)) continue;
      report.at_value("bad-key"_code, place, fmt::format("'{}' is not a key", brief(key)),
                      fmt::format("a key is {}", kIdentifierRule));
    }
  }
  subtree.remappings = static_cast<std::uint32_t>(trees.remappings.size()) - subtree.first;
  if (subtree.id.empty()) {
    report.at("missing-attribute"_code, element.place, "'SubTree' needs the attribute 'ID'",
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
