#include "definition/script_entries.h"

#include <fmt/format.h>

#include <vector>

#include "core/parameter_value.h"
#include "core/suggest.h"
#include "core/wording.h"
#include "definition/btcpp/literal.h"
#include "definition/script_types.h"

namespace lockstep {
namespace {

class Declarer {
 public:
  Declarer(Definition& definition, const StartTexts& starts, const Reporter& report)
      : definition_(definition), starts_(starts), report_(report) {}

  void declare() {
    declare_made();
    for (const auto& [entry, text] : starts_) declare_started(definition_.entries[entry], text);
    declare_made();
    for (const BoundScript& script : definition_.scripts) find_undeclared(script);
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
    std::vector<StaticType> types;
    bool has_open = false;  // one that is declared here, perhaps
    for (std::size_t i = 0; i < script.entries.size(); ++i) {
      const BlackboardEntry& it = entry(script, i);
      types.push_back(it.is_present ? StaticType{it.type, it.object} : StaticType{});
      has_open |= !it.is_present && script.code->uses()[i].is_made;
    }
    if (!has_open) return;
    find_assignments(*script.code, types, [&](std::uint32_t name, const StaticType& type) {
      BlackboardEntry& it = entry(script, name);
      if (it.is_present || !type.type || !script.code->uses()[name].is_made) return;
      make(it, *type.type, type.object);
      it.first_use = script.place;
      types[name] = type;
      set_start(script, name);
    });
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
        script.place, script.code->uses()[name].offset,
        fmt::format("the start value '{}' of '{}' is not {}, which this script makes "
                    "it",
                    brief(start->second), brief(it.name), expected_text(it.type, it.object)),
        "it comes from --set or from an attribute of a SubTree");
  }

  // By the start value alone.
  static void declare_started(BlackboardEntry& it, std::string_view text) {
    if (it.is_present) return;
    const bool is_flag = text == "true" || text == "false";
    make(it, is_flag ? ValueType::Bool : btcpp::literal_type(text), nullptr);
    auto value = parse_value(it.type, text);
    if (!value) {  // not finite
      it.type = ValueType::String;
      value = parse_value(it.type, text);
    }
    it.initial = *std::move(value);
  }

  void find_undeclared(const BoundScript& script) const {
    for (std::size_t i = 0; i < script.entries.size(); ++i) {
      const std::string_view key = script.code->names()[i];
      const bool is_outer = key.starts_with('@');
      if ((!is_outer && entry(script, i).is_present) || report_.counted_only(Severity::Error)) {
        continue;
      }
      report_.in_value(
          script.place, script.code->uses()[i].offset,
          is_outer ? fmt::format("'{}' is not a key", brief(key))
                   : fmt::format("nothing declares the entry '{}'", brief(key)),
          is_outer ? fmt::format("an attribute of the SubTree gives it an entry from outside: "
                                 "{0}=\"{{{0}}}\"",
                                 brief(key.substr(1)))
                   : hint_for_undeclared(key, entry(script, i)));
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
    return fmt::format("a port that uses {{{0}}} gives it a type, or a script: '{0} := 0'",
                       brief(key));
  }

  Definition& definition_;
  const StartTexts& starts_;
  const Reporter& report_;
};

}  // namespace

void declare_entries(Definition& definition, const StartTexts& starts, const Reporter& report) {
  Declarer(definition, starts, report).declare();
}

}  // namespace lockstep
