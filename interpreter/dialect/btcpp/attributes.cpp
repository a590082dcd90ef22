#include "dialect/btcpp/attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/blackboard/conversion.h"
#include "base/core/element_types.h"
#include "base/core/identifier.h"
#include "base/core/parameter_value.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "dialect/btcpp/rules.h"
#include "dialect/btcpp/words.h"
#include "tree/check/scripts.h"

namespace lockstep::host::btcpp {
namespace {

// Those that are not ports.
const auto kOwn = [] {
  std::array<std::string_view, kHooks + 3> names{"_autoremap", kRules.on_resume, kRules.commit};
  std::ranges::copy(kRules.hooks, names.begin() + 3);
  return names;
}();

// A word that has no meaning may be a misspelled one that has.
void check_mark(const Attribute& attribute, const Reporter& report) {
  if (!attribute.name.starts_with('_') || attribute.name == "_description") return;
  if (std::ranges::find(kOwn, attribute.name) != kOwn.end()) return;
  if (std::ranges::find(kMarks, attribute.name) != std::end(kMarks)) return;
  const std::string hint = did_you_mean(attribute.name, kOwn);
  if (hint.empty() || report.counted_only(Severity::Warning)) return;
  report.at("ignored-attribute"_code, attribute.place,
            fmt::format("the attribute '{}' is ignored", brief(attribute.name)), hint,
            Severity::Warning);
}

class PortChecker {
 public:
  PortChecker(const NodeElement& element, const Reporter& report, CheckedNode& node,
              CheckedTrees& trees)
      : element_(element), report_(report), node_(node), trees_(trees) {}

  void check() {
    find_unknown();
    const auto parameters = node_.type->parameters;
    const std::size_t first_value = trees_.values.size();
    node_.first = static_cast<std::uint32_t>(trees_.ports.size());
    trees_.ports.resize(node_.first + parameters.size());
    trees_.values.resize(first_value + parameters.size());
    const auto ports = std::span(trees_.ports).subspan(node_.first);
    const auto values = std::span(trees_.values).subspan(first_value);
    bool good = true;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      good &= check(parameters[i], ports[i], values[i]);
    }
    if (good) check_rule(element_, report_, node_, ports, values);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (std::holds_alternative<NoValue>(values[i])) continue;
      ports[i].value = static_cast<std::uint32_t>(first_value + i);
    }
  }

 private:
  void find_unknown() const {
    for (const Attribute& attribute : element_.attributes) {
      if (!names_port(attribute.name)) {
        check_mark(attribute, report_);
      } else if (is_unknown(attribute.name) && !report_.counted_only(Severity::Error)) {
        report_.at(
            "unknown-port"_code, attribute.place,
            fmt::format("'{}' has no port '{}'", brief(node_.type->id), brief(attribute.name)),
            unknown_hint(attribute.name));
      }
    }
  }

  bool is_unknown(std::string_view name) const {
    return name != "name" && name != "ID" && names_port(name) &&
           !matches_any(node_.type->more_parameters, name) &&
           std::ranges::find(node_.type->parameters, name, &Parameter::name) ==
               node_.type->parameters.end();
  }

  // Only a leaf of ours has ports with a '.', and then some of those that its element may have.
  bool names_port(std::string_view name) const {
    const auto has_dot = [](std::string_view text) { return text.find('.') != text.npos; };
    return is_port_name(name) || (has_dot(name) && std::ranges::any_of(node_.type->parameters,
                                                                       has_dot, &Parameter::name));
  }

  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    for (const Parameter& it : node_.type->parameters) names.push_back(it.name);
    return names;
  }

  std::string unknown_hint(std::string_view name) const {
    const auto all = names();
    if (all.empty()) return fmt::format("'{}' has no ports", brief(node_.type->id));
    return suggest(name, all, fmt::format("ports of '{}'", brief(node_.type->id)));
  }

  // Reads a port as a value, a key with its default, or nothing. Returns false after an error.
  bool check(const Parameter& parameter, CheckedPort& port, Value& value) {
    const Attribute* attribute = find_attribute(element_.attributes, parameter.name);
    if (attribute == nullptr) return absent(parameter, port, value);
    port.place = attribute->place;
    if (parameter.is_template) return literal(parameter, *attribute, port, value);
    port.key = key_of(attribute->value, parameter.name);
    const bool blank_around = without_blanks_around(attribute->value) != attribute->value;
    if (!port.key.empty() && parameter.constant) {
      report_.at_value("fixed-parameter"_code, attribute->place,
                       fmt::format("'{}' of '{}' cannot be a blackboard entry", parameter.name,
                                   brief(node_.type->id)),
                       "it is fixed when the tree is loaded: write a value");
      return false;
    }
    if (!port.key.empty()) {
      trees_.names_at_run_time |= parameter.is_script || parameter.is_key;
      return !blank_around || check_blanks(parameter, *attribute);
    }
    if (!parameter.is_key && !parameter.names_entry) {
      return literal(parameter, *attribute, port, value);
    }
    if (attribute->value.empty()) return empty_name(parameter, *attribute);
    port.key = attribute->value;
    value = std::string(attribute->value);
    return true;
  }

  bool absent(const Parameter& parameter, CheckedPort& port, Value& value) const {
    if (!parameter.default_key.empty()) {
      port.place = element_.place;
      port.key = parameter.default_key;
      return true;
    }
    if (parameter.default_text) {
      port.place = element_.place;
      port.key = key_of(*parameter.default_text, parameter.name);
      if (port.key.empty()) value = *parse_value(parameter.type, *parameter.default_text);
      return true;
    }
    if (!parameter.required) return true;
    if (is_misspelled(parameter)) return false;
    report_.at("missing-port"_code, element_.place,
               fmt::format("'{}' needs the port '{}'", brief(node_.type->id), parameter.name),
               fmt::format("ports of '{}': {}", brief(node_.type->id), listed(names())));
    return false;
  }

  // An unknown attribute means this port: one error is enough.
  bool is_misspelled(const Parameter& missing) const {
    return std::ranges::any_of(element_.attributes, [&](const Attribute& attribute) {
      return is_unknown(attribute.name) && nearest(attribute.name, names()) == missing.name;
    });
  }

  // Nothing can read an entry without a name.
  bool empty_name(const Parameter& parameter, const Attribute& attribute) const {
    report_.at_value("needs-entry"_code, attribute.place,
                     fmt::format("'{}' names no entry", parameter.name),
                     parameter.is_key ? fmt::format("write {}=\"key\"", parameter.name)
                                      : fmt::format("write {}=\"{{key}}\"", parameter.name),
                     parameter.is_key ? Severity::Warning : Severity::Error);
    return parameter.is_key;
  }

  // With blanks around its braces, it must also be a literal of the type.
  bool check_blanks(const Parameter& parameter, const Attribute& attribute) const {
    if (value_from_text(parameter.type, parameter.object, attribute.value)) return true;
    report_.at_value(
        "whitespace"_code, attribute.place,
        fmt::format("there is whitespace around the entry '{}'",
                    brief(without_blanks_around(attribute.value))),
        fmt::format("write {}=\"{}\"", parameter.name, without_blanks_around(attribute.value)));
    return false;
  }

  bool literal(const Parameter& parameter, const Attribute& attribute, CheckedPort& port,
               Value& value) {
    if (parameter.is_script) {
      const bool decides = node_.type->category != NodeCategory::Action || parameter.is_template;
      return read_script(attribute, report_, parameter,
                         decides ? EmptyScript::IsRefused : EmptyScript::DoesNothing, port, trees_);
    }
    auto read = value_from_text(parameter.type, parameter.object, attribute.value);
    if (!read) {
      report_no_value(attribute, report_, *node_.type, parameter);
      return false;
    }
    if (read->has_rest) warn_of_rest(parameter, attribute);
    if (parameter.direction == Direction::Output) {
      report_.at_value(
          "lost-output"_code, attribute.place,
          fmt::format("what '{}' writes to '{}' is lost", brief(node_.type->id), parameter.name),
          fmt::format("write {}=\"{{key}}\"", parameter.name), Severity::Warning);
      return true;
    }
    if (const auto refused = refuse_value(parameter, read->value)) {
      report_refusal(attribute, report_, *node_.type, parameter, *refused);
      return false;
    }
    value = std::move(read->value);
    return true;
  }

  void warn_of_rest(const Parameter& parameter, const Attribute& attribute) const {
    if (report_.counted_only(Severity::Warning)) return;
    report_.at_value("partly-read"_code, attribute.place,
                     fmt::format("'{}' is only read as far as it is {}", brief(attribute.value),
                                 expected_text(parameter.type, parameter.object)),
                     "what comes after that is ignored", Severity::Warning);
  }

  const NodeElement& element_;
  const Reporter& report_;
  CheckedNode& node_;
  CheckedTrees& trees_;
};

}  // namespace

void read_attributes(const NodeElement& element, const Reporter& report, CheckedNode& node,
                     CheckedTrees& trees) {
  PortChecker(element, report, node, trees).check();
  trees.names_at_run_time |= node.type->opens_entries;
  trees.shares_entries |= node.type->opens_entries;
  check_hooks(element, report, node, trees);
  check_at_cut(element, report, node, kRules);
}

namespace {

Remapping remapping(std::string_view name, std::string_view value, Place place) {
  const auto key = key_of(value, name);
  return {name, key.empty() ? value : key, !key.empty(), place};
}

// The attribute that the model does not have, and that may mean this port; null: there is none.
const Attribute* misspelled(const NodeElement& element, const Model& model, std::string_view port) {
  std::vector<std::string_view> names;
  for (const ModelPort& it : model.ports) names.push_back(it.name);
  const auto it = std::ranges::find_if(element.attributes, [&](const Attribute& attribute) {
    return is_port_name(attribute.name) && attribute.name != "name" && attribute.name != "ID" &&
           model.port(attribute.name) == nullptr && nearest(attribute.name, names) == port;
  });
  return it == element.attributes.end() ? nullptr : &*it;
}

// Adds the ports that the model declares and the element does not give.
std::vector<Attribute> add_defaults(const NodeElement& element, const Model& model,
                                    const Reporter& report, std::string_view id,
                                    CheckedTrees& trees) {
  std::vector<Attribute> defaults;
  for (const ModelPort& port : model.ports) {
    if (find_attribute(element.attributes, port.name) != nullptr) continue;
    if (port.default_value) {
      auto& it =
          trees.remappings.emplace_back(remapping(port.name, *port.default_value, element.place));
      it.is_written = false;
      defaults.push_back({port.name, *port.default_value, element.place});
    } else if (report.counted_only(Severity::Error)) {
      continue;
    } else if (const Attribute* wrong = misspelled(element, model, port.name)) {
      report.at("unknown-port"_code, wrong->place,
                fmt::format("the model of the SubTree '{}' has no port '{}'", brief(id),
                            brief(wrong->name)),
                fmt::format("did you mean '{}'?; the model declares it without a default",
                            brief(port.name)));
    } else {
      report.at("missing-port"_code, element.place,
                fmt::format("the SubTree '{}' needs the port '{}'", brief(id), brief(port.name)),
                "its model in TreeNodesModel declares it without a default; _autoremap=\"true\" "
                "takes it from outside");
    }
  }
  return defaults;
}

}  // namespace

std::vector<Attribute> read_subtree_attributes(const NodeElement& element, const Models& models,
                                               const Reporter& report, CheckedNode& node,
                                               CheckedSubTree& subtree, CheckedTrees& trees) {
  subtree.first = static_cast<std::uint32_t>(trees.remappings.size());
  for (const Attribute& attribute : element.attributes) {
    const auto& [name, value, place] = attribute;
    if (name == "name") continue;
    if (name == "ID") {
      subtree.id = value;
      subtree.place = place;
    } else if (name == "_autoremap") {
      const auto autoremap = value_from_text(ValueType::Bool, nullptr, value);
      subtree.autoremap = autoremap && autoremap->value == Value(true);
      if (!autoremap) {
        report.at_value("bad-value"_code, place,
                        fmt::format("'{}' is not true or false", brief(value)));
      }
    } else if (is_port_name(name)) {
      trees.remappings.push_back(remapping(name, value, place));
    } else if (name == "__shared_blackboard") {
      report.at("ignored-attribute"_code, place, "'__shared_blackboard' is ignored since version 4",
                "write _autoremap=\"true\"", Severity::Warning);
    } else {
      check_mark(attribute, report);
    }
  }
  const auto model = models.subtrees.find(subtree.id);
  std::vector<Attribute> defaults;
  if (model != models.subtrees.end() && !subtree.autoremap) {
    defaults = add_defaults(element, model->second, report, subtree.id, trees);
  }
  subtree.remappings = static_cast<std::uint32_t>(trees.remappings.size()) - subtree.first;
  if (subtree.id.empty()) {
    report.at("missing-attribute"_code, element.place, "'SubTree' needs the attribute 'ID'",
              "write <SubTree ID=\"…\"/> with the ID of a BehaviorTree");
  }
  check_hooks(element, report, node, trees);
  return defaults;
}

}  // namespace lockstep::host::btcpp
