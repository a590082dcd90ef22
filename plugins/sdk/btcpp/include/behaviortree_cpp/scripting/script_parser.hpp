// Scripts in a program, as Script nodes and conditions have them: over the entries of a blackboard,
// in a tree or not.
#pragma once

#include <lockstep/runtime.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "behaviortree_cpp/blackboard.h"

namespace BT {

using EnumsTable = std::unordered_map<std::string, int>;
using EnumsTablePtr = std::shared_ptr<EnumsTable>;

namespace Ast {
// The entries and words that a script sees.
struct Environment {
  Blackboard::Ptr vars;
  EnumsTablePtr enums;  // null: no words
};
}  // namespace Ast

namespace lockstep_detail {

class Script {
 public:
  // Throws when the text is none.
  explicit Script(std::string text) : text_(std::move(text)), it_(parse(nullptr)) {}

  Any run(const Ast::Environment& environment) {
    const std::lock_guard lock(mutex_);
    know(environment.enums);
    std::vector<EntryValue> given(lockstep_script_name_count(it_.get()));
    std::vector<lockstep_entry_value> values;
    for (std::uint32_t i = 0; i < given.size(); ++i) {
      read(environment, lockstep_script_name(it_.get(), i), given[i]);
      values.push_back(given[i].it);
    }
    EntryValue result;
    const bool is_good = lockstep_script_run(it_.get(), values.data(), &result.it);
    const std::string error = lockstep_last_error();
    for (std::uint32_t i = 0; i < given.size(); ++i) {
      if (values[i].writes == 0) continue;
      environment.vars->lockstep_store(lockstep_script_name(it_.get(), i), value_of(values[i]),
                                       type_of_entry(values[i]));
    }
    if (!is_good) throw RuntimeError("the script '", text_, "': ", error);
    return value_of(result.it);
  }

 private:
  struct Free {
    void operator()(lockstep_script* script) const { lockstep_script_free(script); }
  };
  using Handle = std::unique_ptr<lockstep_script, Free>;

  Handle parse(const lockstep_words* words) const {
    Handle made(lockstep_script_new(text_.data(), text_.size(), words));
    if (made == nullptr) throw RuntimeError("the script ", lockstep_last_error());
    return made;
  }
  // Words are numbers from when it is parsed.
  void know(const EnumsTablePtr& enums) {
    const EnumsTable wanted = enums == nullptr ? EnumsTable() : *enums;
    if (wanted == enums_) return;
    std::vector<const char*> words;
    std::vector<double> numbers;
    for (const auto& [word, number] : wanted) {
      words.push_back(word.c_str());
      numbers.push_back(number);
    }
    const lockstep_words table{sizeof table, static_cast<std::uint32_t>(words.size()), words.data(),
                               numbers.data()};
    it_ = parse(&table);
    enums_ = wanted;
  }
  static void read(const Ast::Environment& environment, const char* name, EntryValue& value) {
    if (environment.vars == nullptr) throw RuntimeError("the script has no blackboard");
    const auto found = environment.vars->lockstep_find(name);
    if (found.entry == nullptr) return;
    const auto content = Blackboard::lockstep_locked(found);
    declare(found.entry->info, value);
    if (!describe(*std::as_const(content).get(), value)) {
      throw RuntimeError("the entry '", name, "' has a value that no script can use");
    }
  }

  const std::string text_;
  std::mutex mutex_;
  Handle it_;
  EnumsTable enums_;  // that it was parsed with
};

}  // namespace lockstep_detail

// Run it over an environment; it throws when the script fails.
using ScriptFunction = std::function<Any(Ast::Environment&)>;

[[nodiscard]] inline Expected<ScriptFunction> ParseScript(const std::string& script) {
  try {
    const auto parsed = std::make_shared<lockstep_detail::Script>(script);
    return ScriptFunction([parsed](Ast::Environment& it) { return parsed->run(it); });
  } catch (const std::exception& error) {
    return nonstd::make_unexpected(std::string(error.what()));
  }
}

[[nodiscard]] inline Result ValidateScript(const std::string& script) {
  auto parsed = ParseScript(script);
  if (!parsed) return nonstd::make_unexpected(std::move(parsed.error()));
  return std::monostate{};
}

[[nodiscard]] inline Expected<Any> ParseScriptAndExecute(Ast::Environment& environment,
                                                         const std::string& script) {
  const auto parsed = ParseScript(script);
  if (!parsed) return nonstd::make_unexpected(parsed.error());
  try {
    return (*parsed)(environment);
  } catch (const std::exception& error) {
    return nonstd::make_unexpected(std::string(error.what()));
  }
}

}  // namespace BT
