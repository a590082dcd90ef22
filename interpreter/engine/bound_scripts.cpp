#include "engine/bound_scripts.h"

#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/wording.h"

namespace lockstep::host {

BoundScripts::BoundScripts(const Tree& tree, Blackboard& board, NamedEntries& names,
                           Readings& readings)
    : tree_(tree), names_(names) {
  std::size_t entries = 0;
  for (const Script& script : tree.scripts) {
    entries += script.slots.size() + script.readings.size();
  }
  entries_.reserve(entries);
  scripts_.reserve(tree.scripts.size());
  for (const Script& script : tree.scripts) {
    Bound& bound = scripts_.emplace_back(Bound{.code = script.code.get()});
    if (script.code == nullptr) {
      bound.source = std::make_unique<FromEntry>(&board.entries[script.slots.front()]);
      continue;
    }
    bound.entries = {entries_.data() + entries_.size(),
                     script.slots.size() + script.readings.size()};
    bound.comparison = script.code->comparison();
    bound.change = only_change(script.code->program().code);
    for (const std::uint32_t slot : script.slots) entries_.push_back(&board.entries[slot]);
    for (const std::uint32_t number : script.readings) entries_.push_back(readings.at(number));
    if (bound.comparison != nullptr) bound.compared = &bound.entries.front()->value();
  }
}

bool BoundScripts::evaluate_entry(NodeIndex node, std::uint32_t script) {
  if (!compile(node, script)) return false;
  const Bound& it = scripts_[script];
  return it.code == nullptr || evaluator_.evaluate(*it.code, it.entries, value_);
}

bool BoundScripts::run_all(NodeIndex node, std::uint32_t script) {
  const Bound& it = scripts_[script];
  if (it.source != nullptr && !compile(node, script)) return false;
  return it.code == nullptr || evaluator_.execute(*it.code, it.entries);
}

Truth BoundScripts::test_all(NodeIndex node, std::uint32_t script) {
  const Bound& it = scripts_[script];
  if (it.source != nullptr && !compile(node, script)) return Truth::Error;
  if (it.code != nullptr) return evaluator_.test(*it.code, it.entries);
  evaluator_.fail("the script is empty");
  return Truth::Error;
}

void BoundScripts::reset() {
  for (Bound& it : scripts_) {
    if (it.source != nullptr) it.code = nullptr;
  }
}

// Compiles the text that the entry has now.
bool BoundScripts::compile(NodeIndex node, std::uint32_t script) {
  Bound& it = scripts_[script];
  FromEntry& source = *it.source;
  const Value& value = source.entry->value();
  const auto* const same = std::get_if<std::string>(&value);
  if (it.code != nullptr && same != nullptr && *same == source.text) return true;
  it.code = nullptr;
  const std::string& key = tree_.slots[tree_.scripts[script].slots.front()].name;
  auto text = convert_value(value, ValueType::String, nullptr);
  if (!text) return evaluator_.fail("the entry '{" + key + "}' has no script");
  source.text = std::get<std::string>(*std::move(text));
  if (source.text.empty()) return true;
  auto code = Expression::parse(source.text, tree_.words);
  if (!code) {
    return evaluator_.fail("'" + brief(source.text) + "' in '{" + key + "}', column " +
                           std::to_string(code.error().offset + 1) + ": " + code.error().message);
  }
  if (!code->readings().empty()) {
    return evaluator_.fail("'" + shown(code->readings().front()) + "' in the script of '{" + key +
                           "}': only a script that is written in the tree reads nodes");
  }
  source.code = *std::move(code);
  it.code = &source.code;
  source.entries.clear();
  const std::uint32_t board = tree_.board_of(node);
  for (const std::string& name : source.code.names()) {
    source.entries.push_back(&names_.at(board, name));
  }
  it.entries = source.entries;
  return true;
}

}  // namespace lockstep::host
