#include "support/tree_text.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <stdexcept>

#include "engine/compile.h"
#include "support/plugin_nodes.h"
#include "support/scripted_types.h"
#include "tree/expand/readings.h"
#include "tree/expand/resources.h"
#include "tree/pace.h"
#include "tree/types/script_entries.h"

namespace lockstep::host::test {
namespace {

struct Attribute {
  std::string_view name, value;
};

bool is_choice(const Parameter& parameter, const Value& value) {
  const auto* word = std::get_if<std::string>(&value);
  return word == nullptr || parameter.choices.empty() ||
         std::ranges::find(parameter.choices, *word) != parameter.choices.end();
}

class Builder {
 public:
  Builder(std::string_view text, const LanguageRules& rules)
      : all_(text), rest_(text), rules_(rules) {
    definition_.rules = &rules;
  }

  Definition build() {
    node(0);
    for (skip_blanks(); !rest_.empty(); skip_blanks()) group();
    if (!members_.empty()) fail("no group '" + members_.begin()->first + "'");
    definition_.id = "Test";
    if (names_at_run_time_) keep_board();
    check();
    mark_slowed(definition_);
    return std::move(definition_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::invalid_argument("tree text '" + std::string(all_) + "' at '" + std::string(rest_) +
                                "': " + reason);
  }
  void skip_blanks() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  }
  bool take(char character) {
    if (!rest_.starts_with(character)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::string_view take_until(std::string_view ends) {
    const auto length = std::min(rest_.find_first_of(ends), rest_.size());
    const auto taken = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return taken;
  }

  std::vector<Attribute> attributes() {
    std::vector<Attribute> list;
    if (!take('[')) return list;
    for (skip_blanks(); !take(']'); skip_blanks()) {
      if (rest_.empty()) fail("expected ']'");
      const auto text = take_until(" ]");
      const auto equal = std::min(text.find('='), text.size());
      list.push_back({text.substr(0, equal), text.substr(std::min(equal + 1, text.size()))});
    }
    return list;
  }

  void node(std::uint32_t parent) {
    skip_blanks();
    const auto name = take_until(" ()[]?");
    if (name.empty()) fail("expected a name");
    const auto self = static_cast<std::uint32_t>(definition_.nodes.size());
    definition_.nodes.emplace_back();
    const bool built_in = std::isupper(static_cast<unsigned char>(name[0])) != 0;
    const bool has_scripts = rest_.starts_with('[') && !rest_.starts_with("[bare]");
    auto given = built_in || has_scripts ? attributes() : std::vector<Attribute>();
    const std::uint32_t hooks = take_hooks(given);
    const NodeType& type = built_in ? built_in_type(name) : scripted_type(!given.empty());
    join(type, given, self);
    const std::uint32_t children = take('(') ? nodes_until_end(self) : 0;
    if (children < type.arity.min || children > type.arity.max) {
      fail("arity of " + std::string(type.id));
    }
    const std::uint32_t first = parameters(type, given, children);
    DefinitionNode& it = definition_.nodes[self];
    it.type = &type;
    it.parent = parent;
    it.name = name;
    it.children = children;
    it.first = first;
    it.hooks = hooks;
    it.end = static_cast<std::uint32_t>(definition_.nodes.size());
  }

  // Takes those that are scripts out of `given`.
  std::uint32_t take_hooks(std::vector<Attribute>& given) {
    NodeHooks hooks;
    hooks.fill(Port::kNone);
    for (std::size_t hook = 0; hook < kHooks; ++hook) {
      const std::string_view name = attribute_of(static_cast<Hook>(hook), rules_);
      const auto it = std::ranges::find(given, name, &Attribute::name);
      if (it == given.end()) continue;
      hooks[hook] = script(it->value);
      given.erase(it);
    }
    if (std::ranges::count(hooks, Port::kNone) == kHooks) return Port::kNone;
    definition_.hooks.push_back(hooks);
    return static_cast<std::uint32_t>(definition_.hooks.size() - 1);
  }

  std::uint32_t script(std::string_view text, bool is_template = false) {
    if (text.empty()) return Port::kNone;
    if (text.starts_with('{') && !is_template) {
      names_at_run_time_ = true;
      definition_.scripts.push_back({.entries = {entry(key_in(text), ValueType::String)}});
      return static_cast<std::uint32_t>(definition_.scripts.size() - 1);
    }
    auto code = is_template ? Expression::parse_template(text) : Expression::parse(text);
    if (!code) fail(code.error().message);
    BoundScript& bound = definition_.scripts.emplace_back();
    bound.code = std::make_shared<const Expression>(std::move(*code));
    for (const std::string& name : bound.code->names()) {
      bound.entries.push_back(entry(name, std::nullopt));
    }
    return static_cast<std::uint32_t>(definition_.scripts.size() - 1);
  }

  static std::string_view key_in(std::string_view text) { return text.substr(1, text.size() - 2); }

  // Of the main tree, which is the only one.
  void keep_board() {
    Board& board = definition_.boards.emplace_back();
    for (std::uint32_t i = 0; i < definition_.entries.size(); ++i) {
      board.entries.emplace(definition_.entries[i].name, i);
    }
  }

  // What the language's reader does after it has expanded the trees.
  void check() {
    const Sources sources;
    Diagnostics diagnostics;
    const Reporter reporter(sources, diagnostics);
    if (rules_.strict_types) declare_entries(definition_, {}, reporter);
    resolve_resources(definition_, reporter);
    resolve_readings(definition_, reporter);
    if (reporter.has_errors()) fail("a script reads what is not there");
  }

  // "barrier[name=g delta=.1]", behind the tree.
  void group() {
    const auto tag = take_until(" []");
    auto given = attributes();
    const auto name = std::ranges::find(given, "name", &Attribute::name);
    if (name == given.end()) fail("text after the tree");
    const std::string_view id = name->value;
    given.erase(name);
    const NodeType& type = built_in_type(tag);
    const auto self = static_cast<std::uint32_t>(definition_.nodes.size());
    definition_.groups.push_back({self, std::move(members_[std::string(id)])});
    members_.erase(std::string(id));
    const std::uint32_t first = parameters(type, given, 0);
    definition_.nodes.push_back({.type = &type,
                                 .end = self + 1,
                                 .parent = self,
                                 .children = 0,
                                 .first = first,
                                 .name = id});
  }

  void join(const NodeType& type, const std::vector<Attribute>& given, std::uint32_t self) {
    for (const Parameter& parameter : type.parameters) {
      if (parameter.group.empty()) continue;
      const auto name = std::ranges::find(given, parameter.name, &Attribute::name);
      members_[std::string(name->value)].push_back(self);
    }
  }

  std::uint32_t nodes_until_end(std::uint32_t parent) {
    std::uint32_t count = 0;
    for (skip_blanks(); !take(')'); skip_blanks()) {
      if (rest_.empty()) fail("expected ')'");
      node(parent);
      ++count;
    }
    return count;
  }

  const NodeType& scripted_type(bool writes) {
    if (take('?')) return writes ? kWritingConditionType : kScriptedConditionType;
    if (writes) return kWritingActionType;
    return attributes().empty() ? kScriptedActionType : kBareActionType;
  }

  const NodeType& built_in_type(std::string_view name) const {
    for (const NodeKind* kind : built_in_kinds(rules_)) {
      if (kind->type.id == name) return kind->type;
    }
    if (const NodeType* type = plugin_node_type(name)) return *type;
    fail("no node '" + std::string(name) + "'");
  }

  // Appends the ports of a node; returns where they begin.
  std::uint32_t parameters(const NodeType& type, const std::vector<Attribute>& given,
                           std::uint32_t children) {
    const auto first = static_cast<std::uint32_t>(definition_.ports.size());
    const auto first_value = static_cast<std::uint32_t>(definition_.values.size());
    std::vector<Value> values;
    ParameterValues all{.values = {}, .children = children};
    std::size_t used = 0;
    for (const Parameter& parameter : type.parameters) {
      std::optional<std::string_view> text = parameter.default_text;
      Port port;
      for (const Attribute& attribute : given) {
        if (attribute.name != parameter.name) continue;
        ++used;
        if (parameter.is_script) {
          port.script = script(attribute.value, parameter.is_template);
          text = attribute.value;
        } else if (attribute.value.starts_with('{')) {
          names_at_run_time_ |= parameter.is_key;
          port.entry = entry(key_in(attribute.value), type_of(parameter));
          all.from_entry |= std::uint64_t{1} << values.size();
        } else if (parameter.names_entry || parameter.is_key) {
          text = attribute.value;
          const bool is_none = parameter.own_only && attribute.value.starts_with('@');
          if (!is_none) port.entry = entry(attribute.value, std::nullopt);
        } else {
          text = attribute.value;
        }
      }
      const bool is_left_out = port.entry == Port::kNone && text == parameter.default_text;
      if (is_left_out && !parameter.default_key.empty()) {
        port.entry = entry(parameter.default_key, type_of(parameter));
        all.from_entry |= std::uint64_t{1} << values.size();
      }
      if (parameter.required && !text && port.entry == Port::kNone) {
        fail("missing " + std::string(parameter.name));
      }
      const auto value = text ? parse_value(parameter.type, *text) : Value();
      if (!value || !is_choice(parameter, *value)) fail("value of " + std::string(parameter.name));
      values.push_back(*value);
      definition_.ports.push_back(port);
    }
    if (used != given.size()) fail("unknown parameter of " + std::string(type.id));
    std::vector<Value> ruled = values;
    all.values = ruled;
    if (type.rule != nullptr) {
      if (const auto broken = type.rule(all)) fail(broken->message);
    }
    if (all.from_entry == 0) values = std::move(ruled);
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      if (std::holds_alternative<NoValue>(values[i])) continue;
      definition_.ports[first + i].value = first_value + i;
    }
    definition_.values.insert(definition_.values.end(), values.begin(), values.end());
    return first;
  }

  static std::optional<ValueType> type_of(const Parameter& parameter) {
    return parameter.is_generic ? std::nullopt : std::optional(parameter.type);
  }

  // Without a type: one that is not there until it is written.
  std::uint32_t entry(std::string_view key, std::optional<ValueType> type) {
    for (std::uint32_t i = 0; i < definition_.entries.size(); ++i) {
      BlackboardEntry& it = definition_.entries[i];
      if (it.name != key) continue;
      if (type && !it.is_present && rules_.strict_types) {
        it.type = *type;
        it.is_present = true;
      }
      return i;
    }
    definition_.entries.push_back({std::string(key), type.value_or(ValueType::String), {}});
    BlackboardEntry& it = definition_.entries.back();
    it.is_present = type.has_value();
    if (!rules_.strict_types) {
      it.typing = type ? Typing::Declared : Typing::Any;
    }
    return static_cast<std::uint32_t>(definition_.entries.size() - 1);
  }

  std::map<std::string, std::vector<std::uint32_t>> members_;  // of the groups, by name
  std::string_view all_, rest_;
  const LanguageRules& rules_;
  bool names_at_run_time_ = false;
  Definition definition_;
};

}  // namespace

Tree tree_from_text(std::string_view text, const LanguageRules& rules) {
  return compile(Builder(text, rules).build());
}

}  // namespace lockstep::host::test
