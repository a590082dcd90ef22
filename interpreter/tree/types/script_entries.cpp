#include "tree/types/script_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/core/audience.h"
#include "base/core/parameter_value.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "tree/types/literal.h"
#include "tree/types/script_types.h"
#include "tree/types/type_words.h"

namespace lockstep::host {
namespace {

class Declarer {
 public:
  Declarer(Definition& definition, const StartTexts& starts, std::span<const std::uint32_t> guessed,
           const StartTexts& later, const Reporter& report)
      : definition_(definition),
        starts_(starts),
        guessed_(guessed),
        later_(later),
        report_(report) {}

  void declare() {
    declare_made();
    for (const auto& [entry, text] : starts_) declare_started(definition_.entries[entry], text);
    for (const auto& [entry, text] : later_) declare_later(definition_.entries[entry], text);
    declare_made();
    for (const std::uint32_t entry : guessed_) declare_guessed(definition_.entries[entry]);
    if (definition_.scripts.empty()) return;
    const std::vector<bool> conditions = definition_.conditions();
    types_.resize(definition_.scripts.size());
    for (std::size_t i = 0; i < definition_.scripts.size(); ++i) {
      if (!find_undeclared(definition_.scripts[i])) check_types(i, conditions[i]);
    }
    for (const DefinitionNode& node : definition_.nodes) check_cases(node);
  }

 private:
  BlackboardEntry& entry(const BoundScript& script, std::size_t name) const {
    return definition_.entries[script.entries[name]];
  }

  // By ':=', from the first script on: what one declares may be the type of what a later one
  // assigns.
  void declare_made() {
    for (const BoundScript& script : definition_.scripts) declare_made(script);
  }

  void declare_made(const BoundScript& script) {
    std::vector<StaticType> types = types_of(script);
    bool has_open = false;  // one that is declared here, perhaps
    for (std::size_t i = 0; i < script.entries.size(); ++i) {
      has_open |= !entry(script, i).is_present && script.code->uses()[i].is_made;
    }
    if (!has_open) return;
    const auto assigned = [&](std::uint32_t name, const StaticType& type) {
      BlackboardEntry& it = entry(script, name);
      if (it.is_present || !type.type || !script.code->uses()[name].is_made) return;
      make(it, *type.type, type.object);
      it.first_use = script.place;
      types[name] = type;
      set_start(script, name);
    };
    infer_types(*script.code, types, {.assigned = assigned, .wrong = [](auto&&...) {}});
  }

  std::vector<StaticType> types_of(const BoundScript& script) const {
    std::vector<StaticType> types;
    for (std::size_t i = 0; i < script.entries.size(); ++i) {
      const BlackboardEntry& it = entry(script, i);
      const bool is_known = it.is_present && it.typing != Typing::Any;
      types.push_back(is_known ? StaticType{it.type, it.object} : StaticType{});
    }
    return types;
  }

  static void make(BlackboardEntry& it, ValueType type, const ObjectType* object) {
    it.is_present = true;
    it.typing = Typing::Strict;
    it.type = type;
    it.object = object;
  }

  void set_start(const BoundScript& script, std::uint32_t name) const {
    const auto start = starts_.find(script.entries[name]);
    if (start == starts_.end()) return;
    BlackboardEntry& it = entry(script, name);
    auto value = parse_value(it.type, it.object, start->second);
    if (value) {
      it.initial = *std::move(value);
      return;
    }
    report_.in_value(
        "bad-start-value"_code, script.place, script.code->uses()[name].offset,
        fmt::format("the start value '{}' of '{}' is not {}, which this script makes "
                    "it",
                    brief(start->second), brief(it.name), expected_text(it.type, it.object)),
        fmt::format("it comes from {} or from an attribute of a SubTree",
                    worded("--set", "the project")));
  }

  static void declare_guessed(BlackboardEntry& it) {
    if (it.is_present) return;
    it.is_present = true;
    it.typing = Typing::Any;
  }

  // By the start value alone.
  static void declare_started(BlackboardEntry& it, std::string_view text) {
    if (it.is_present) return;
    const bool is_flag = !parse_double(text) && parse_flag(text);
    make(it, is_flag ? ValueType::Bool : literal_type(text), nullptr);
    auto value = parse_value(it.type, text);
    if (!value) {  // not finite
      it.type = ValueType::String;
      value = parse_value(it.type, text);
    }
    it.initial = *std::move(value);
  }

  static void declare_later(BlackboardEntry& it, std::string_view text) {
    it.is_set_later = true;
    if (it.is_present) return;
    declare_started(it, text);
    it.initial = {};
  }

  // Whether there is one.
  bool find_undeclared(const BoundScript& script) const {
    bool found = false;
    for (std::size_t i = 0; i < script.entries.size(); ++i) {
      const std::string_view key = script.code->names()[i];
      const bool is_outer = key.starts_with('@');
      if (!is_outer && entry(script, i).is_present) continue;
      found = true;
      if (report_.counted_only(Severity::Error)) continue;
      report_.in_value(
          "unknown-entry"_code, script.place, script.code->uses()[i].offset,
          is_outer ? fmt::format("'{}' is not a key", brief(key))
                   : fmt::format("nothing declares the entry '{}'", brief(key)),
          is_outer ? fmt::format("an attribute of the SubTree gives it an entry from outside: "
                                 "{0}=\"{{{0}}}\"",
                                 brief(key.substr(1)))
                   : hint_for_undeclared(key, entry(script, i)));
    }
    return found;
  }

  void check_types(std::size_t number, bool is_condition) {
    const BoundScript& script = definition_.scripts[number];
    const auto wrong = [&](std::size_t offset, std::string message) {
      report_.in_value("script-type"_code, script.place, offset, std::move(message), {});
    };
    const std::vector<StaticType> types = types_of(script);
    types_[number] =
        infer_types(*script.code, types, {.assigned = [](auto&&...) {}, .wrong = wrong});
    const StaticType& value = types_[number];
    if (!is_condition || may_be_yes_or_no(value)) return;
    wrong(0, fmt::format("a condition is a yes or a no, not {}",
                         with_article(*value.type, value.object)));
  }

  // Each case of a Switch must be a value that its script can have.
  void check_cases(const DefinitionNode& node) const {
    const auto parameters = node.type->parameters;
    const auto cases = std::ranges::find(parameters, "cases", &Parameter::name);
    const auto script = std::ranges::find(parameters, true, &Parameter::is_script);
    if (cases == parameters.end() || script == parameters.end()) return;
    const Value* const list = definition_.constant(node, "cases");
    const std::uint32_t number =
        definition_.ports[node.first + static_cast<std::size_t>(script - parameters.begin())]
            .script;
    if (list == nullptr || number == Port::kNone || !types_[number].type) return;
    const StaticType& type = types_[number];
    if (type.type == ValueType::String) return;
    for (const std::string& text : std::get<std::vector<std::string>>(*list)) {
      if (may_be_yes_or_no(type) && parse_value(ValueType::Double, text)) continue;
      if (may_be_yes_or_no(type) && parse_value(ValueType::Bool, text)) continue;
      const auto written = definition_.attributes(node);
      const auto place = std::ranges::find(written, "cases", &WrittenAttribute::name);
      report_.at_value("unmatched-case"_code, place->place,
                       fmt::format("the case '{}' is never equal to {}, which '{}' is", brief(text),
                                   with_article(*type.type, type.object), script->name));
      return;
    }
  }

  std::string hint_for_undeclared(std::string_view key, const BlackboardEntry& it) const {
    const std::string_view scope(it.name.data(), it.name.size() - key.size());
    std::vector<std::string_view> keys;
    for (const BlackboardEntry& other : definition_.entries) {
      const std::string_view name = other.name;
      const bool is_inside = name.substr(0, name.rfind('/') + 1) == scope;
      if (other.is_present && is_inside) keys.push_back(name.substr(scope.size()));
    }
    const std::string hint = did_you_mean(key, keys);
    if (!hint.empty()) return hint;
    if (std::ranges::find(kStatuses, key, &StatusRow::name) != kStatuses.end()) {
      return fmt::format("to read the status of a node, write status(NODE) == {}", key);
    }
    return fmt::format("a port that uses {{{0}}} gives it a type, or a script: '{0} := 0'",
                       brief(key));
  }

  Definition& definition_;
  const StartTexts& starts_;
  const std::span<const std::uint32_t> guessed_;
  const StartTexts& later_;
  const Reporter& report_;
  std::vector<StaticType> types_;  // of the value of each script
};

}  // namespace

void declare_entries(Definition& definition, const StartTexts& starts, const Reporter& report,
                     std::span<const std::uint32_t> guessed, const StartTexts& later) {
  Declarer(definition, starts, guessed, later, report).declare();
}

}  // namespace lockstep::host
