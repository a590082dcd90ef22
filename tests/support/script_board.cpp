#include "support/script_board.h"

#include <fmt/format.h>

#include <vector>

namespace lockstep::host::test {

Entry& ScriptBoard::declare(const std::string& name, ValueType type, Value value, Typing typing) {
  Entry& entry = entries_[name];
  make_entry(entry, typing, type);
  entry.assign(std::move(value));
  entry.count_from(0);
  return entry;
}

Entry& ScriptBoard::any(const std::string& name, Value value) {
  return declare(name, ValueType::String, std::move(value), Typing::Any);
}

Entry& ScriptBoard::at(const std::string& name) {
  const auto [entry, is_new] = entries_.try_emplace(name);
  if (is_new) unset_entry(entry->second);
  return entry->second;
}

ScriptRun ScriptBoard::run(std::string_view script) {
  const auto expression = Expression::parse(script, enums_);
  if (!expression) return {.error = "not a script: " + expression.error().message};
  std::vector<Entry*> entries;
  for (const std::string& name : expression->names()) entries.push_back(&at(name));
  ScriptRun run;
  if (!evaluator_.evaluate(*expression, entries, run.value)) run.error = evaluator_.error();
  return run;
}

std::string shown(const Value& value) {
  if (std::holds_alternative<NoValue>(value)) return "none";
  if (const auto* real = std::get_if<double>(&value)) {
    const std::string text = fmt::format("{}", *real);
    return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
  }
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'";
  return to_text(value);
}

}  // namespace lockstep::host::test
