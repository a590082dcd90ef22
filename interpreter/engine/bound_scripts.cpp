#include "engine/bound_scripts.h"

#include <utility>

#include "core/conversion.h"
#include "core/wording.h"

namespace lockstep {

BoundScripts::BoundScripts(const Tree& tree, Blackboard& board, NamedEntries& names)
    : tree_(tree), names_(names) {
  scripts_.reserve(tree.scripts.size());
  for (const Script& script : tree.scripts) {
    Bound& bound = scripts_.emplace_back(Bound{.code = script.code.get()});
    if (script.code == nullptr) {
      bound.source = std::make_unique<FromEntry>(&board.entries[script.slots.front()]);
      continue;
    }
    for (const std::uint32_t slot : script.slots) bound.entries.push_back(&board.entries[slot]);
  }
}

std::string BoundScripts::evaluate(NodeIndex node, std::uint32_t script) {
  const Bound& it = scripts_[script];
  if (it.source != nullptr) {
    std::string wrong = compile(node, script);
    if (!wrong.empty() || it.code == nullptr) return wrong;
  }
  return evaluator_.evaluate(*it.code, it.entries, value_);
}

std::string BoundScripts::test(NodeIndex node, std::uint32_t script, bool& holds) {
  const Bound& it = scripts_[script];
  if (it.source != nullptr) {
    std::string wrong = compile(node, script);
    if (!wrong.empty()) return wrong;
    if (it.code == nullptr) return "the script is empty";
  }
  return evaluator_.test(*it.code, it.entries, holds);
}

void BoundScripts::reset() {
  for (Bound& it : scripts_) {
    if (it.source != nullptr) it.code = nullptr;
  }
}

// What the entry has now.
std::string BoundScripts::compile(NodeIndex node, std::uint32_t script) {
  Bound& it = scripts_[script];
  FromEntry& source = *it.source;
  const Value& value = source.entry->value;
  const auto* const same = std::get_if<std::string>(&value);
  if (it.code != nullptr && same != nullptr && *same == source.text) return {};
  it.code = nullptr;
  const std::string& key = tree_.slots[tree_.scripts[script].slots.front()].name;
  auto text = convert_value(value, ValueType::String, nullptr);
  if (!text) return "the entry '{" + key + "}' has no script";
  source.text = std::get<std::string>(*std::move(text));
  if (source.text.empty()) return {};
  auto code = Expression::parse(source.text, tree_.words);
  if (!code) {
    return "'" + brief(source.text) + "' in '{" + key + "}', column " +
           std::to_string(code.error().offset + 1) + ": " + code.error().message;
  }
  source.code = *std::move(code);
  it.code = &source.code;
  it.entries.clear();
  const std::uint32_t board = tree_.board_of(node);
  for (const std::string& name : source.code.names()) it.entries.push_back(&names_.at(board, name));
  return {};
}

}  // namespace lockstep
