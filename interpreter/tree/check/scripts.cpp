#include "tree/check/scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "base/core/parameter_value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

void report_syntax(const Attribute& attribute, const Reporter& report, Expression::Error error) {
  // A wrong or missing argument was reported already.
  const bool is_known = attribute.value.find("${") == std::string_view::npos;
  if (!is_known && report.has_errors()) return;
  report.in_value("script-syntax"_code, attribute.place, error.offset, std::move(error.message),
                  std::move(error.hint));
}

// Null after an error, which is reported. A text that was there before is not compiled again.
std::shared_ptr<const Expression> parse_script(const Attribute& attribute, const Reporter& report,
                                               CheckedTrees& trees, bool is_template = false) {
  if (is_template) {
    auto text = Expression::parse_template(attribute.value);
    if (text) return std::make_shared<const Expression>(*std::move(text));
    report_syntax(attribute, report, std::move(text.error()));
    return nullptr;
  }
  const auto same = trees.compiled.find(attribute.value);
  if (same != trees.compiled.end()) return same->second;
  const bool is_strict = trees.rules->strict_scripts;
  auto code =
      Expression::parse(attribute.value, trees.words,
                        is_strict ? Expression::Words::AreSigns : Expression::Words::AreNames);
  if (!code) {
    report_syntax(attribute, report, std::move(code.error()));
    return nullptr;
  }
  for (const auto& remark : code->remarks()) {
    report.in_value("loose-script"_code, attribute.place, remark.offset, remark.message,
                    remark.hint, is_strict ? Severity::Error : Severity::Warning);
  }
  if (is_strict && !code->remarks().empty()) return nullptr;
  const bool is_clean = code->remarks().empty();  // else each place has its messages
  auto script = std::make_shared<const Expression>(*std::move(code));
  if (is_clean) trees.compiled.emplace(attribute.value, script);
  return script;
}

// The moment at which the script in an attribute runs. A parameter of that name comes first.
std::optional<Hook> hook_of(const NodeType& type, std::string_view attribute,
                            const LanguageRules& rules) {
  const auto hook = hook_named(attribute, rules);
  if (!hook ||
      std::ranges::find(type.parameters, attribute, &Parameter::name) != type.parameters.end()) {
    return std::nullopt;
  }
  return hook;
}

}  // namespace

bool read_script(const Attribute& attribute, const Reporter& report, const Parameter& parameter,
                 EmptyScript empty, CheckedPort& port, CheckedTrees& trees) {
  if (attribute.value.empty() && empty == EmptyScript::DoesNothing) return true;
  auto code = parse_script(attribute, report, trees, parameter.is_template);
  if (code == nullptr) return false;
  port.value = static_cast<std::uint32_t>(trees.scripts.size());
  trees.scripts.push_back({{}, attribute.place, true, std::move(code)});
  return true;
}

void check_hooks(const NodeElement& element, const Reporter& report, CheckedNode& node,
                 CheckedTrees& trees) {
  const auto first = static_cast<std::uint32_t>(trees.scripts.size());
  for (const Attribute& attribute : element.attributes) {
    const auto hook = hook_of(*node.type, attribute.name, *trees.rules);
    if (!hook) continue;
    auto code = parse_script(attribute, report, trees);
    if (code != nullptr) {
      trees.scripts.push_back({*hook, attribute.place, false, std::move(code)});
    }
  }
  if (trees.scripts.size() == first) return;
  trees.scripts.back().is_last = true;
  node.scripts = first;
}

// A port of such a name comes first.
void check_at_cut(const NodeElement& element, const Reporter& report, CheckedNode& node,
                  const LanguageRules& rules) {
  const NodeType& type = *node.type;
  for (const Attribute& attribute : element.attributes) {
    if (!is_of_actions(attribute.name, rules) || type.category != NodeCategory::Action ||
        std::ranges::find(type.parameters, attribute.name, &Parameter::name) !=
            type.parameters.end()) {
      continue;
    }
    if (type.leaf == nullptr && type.mock == nullptr) {
      report.at("unknown-attribute"_code, attribute.place,
                fmt::format("'{}' is for actions of plugins", attribute.name),
                "what built-in nodes do is kept in the checkpoint: leave it out");
    } else if (attribute.name == rules.commit) {
      const auto commits = parse_value(ValueType::Bool, attribute.value);
      if (commits) {
        node.at_cut.commits = *commits == Value(true);
        continue;
      }
      report.at_value("bad-value"_code, attribute.place,
                      fmt::format("'{}' is not true or false", brief(attribute.value)));
    } else if (const auto does = after_cut_named(attribute.value)) {
      node.at_cut.otherwise = *does;
      node.at_cut.is_given = true;
    } else {
      report.at_value(
          "bad-value"_code, attribute.place,
          fmt::format("'{}' is not restart, failure or success", brief(attribute.value)));
    }
  }
}

}  // namespace lockstep::host
