// lockstep_script: a script over values that a program gives.
#include <fmt/format.h>

#include <list>

#include "base/core/wording.h"
#include "embedding/handles.h"
#include "language/expression/evaluator.h"
#include "leaves/plugin/contract/entry_value.h"

struct lockstep_script {
  lockstep::host::Expression code;
  lockstep::host::Evaluator evaluator = {};
  std::vector<lockstep::host::Entry> entries = {};  // of its names
  lockstep::host::Entry result = {};
  // Holds the lists of texts that the last run has given.
  std::list<std::vector<lockstep_text>> texts = {};
};

namespace lockstep::host::embedding {
namespace {

std::shared_ptr<const ScriptEnums> enums_from(const lockstep_words* words) {
  if (words == nullptr || words->count == 0) return nullptr;
  ScriptEnums enums;
  for (std::uint32_t i = 0; i < words->count; ++i) enums[words->words[i]] = words->numbers[i];
  return std::make_shared<const ScriptEnums>(std::move(enums));
}

bool take(lockstep_script& script, const lockstep_entry_value* values) {
  script.texts.clear();
  for (std::size_t i = 0; i < script.entries.size(); ++i) {
    Entry& entry = script.entries[i];
    unset_entry(entry);
    const lockstep_entry_value value = read_struct(&values[i]);
    if (value.declared != 0 && !assign(entry, value)) {
      return fail(fmt::format("'{}' has no value of its type", script.code.names()[i]));
    }
    entry.count_from(0);
  }
  return true;
}

lockstep_entry_value given_back(lockstep_script& script, const Entry& entry) {
  lockstep_entry_value value = described(entry, script.texts.emplace_back());
  if (!entry.is_present) value.declared = 0;
  value.writes = entry.writes();
  return value;
}

bool run(lockstep_script& script, lockstep_entry_value* values, lockstep_entry_value* result) {
  if (!take(script, values)) return false;
  std::vector<Entry*> entries;
  for (Entry& entry : script.entries) entries.push_back(&entry);
  script.result = Entry(Typing::Any);
  const bool is_good = script.evaluator.evaluate(script.code, entries, script.result.to_write());
  if (!is_good) fail(script.evaluator.error());
  for (std::size_t i = 0; i < script.entries.size(); ++i) {
    if (!write_struct(given_back(script, script.entries[i]), &values[i])) return false;
  }
  return is_good && (result == nullptr || write_struct(given_back(script, script.result), result));
}

}  // namespace
}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

lockstep_script* lockstep_script_new(const char* text, size_t length, const lockstep_words* words) {
  return guarded([&]() -> lockstep_script* {
    if (!is_text("the script", text, length)) return nullptr;
    auto code = Expression::parse({text, length}, enums_from(words));
    if (!code) {
      const Expression::Error& it = code.error();
      fail(fmt::format("'{}', column {}: {}{}{}", brief({text, length}), it.offset + 1, it.message,
                       it.hint.empty() ? "" : "; ", it.hint));
      return nullptr;
    }
    auto script = std::make_unique<lockstep_script>(lockstep_script{*std::move(code)});
    script->entries.resize(script->code.names().size());
    return script.release();
  });
}

void lockstep_script_free(lockstep_script* script) {
  delete script;
}

uint32_t lockstep_script_name_count(const lockstep_script* script) {
  return script == nullptr ? 0 : static_cast<uint32_t>(script->entries.size());
}

const char* lockstep_script_name(const lockstep_script* script, uint32_t index) {
  return index < lockstep_script_name_count(script) ? script->code.names()[index].c_str() : nullptr;
}

bool lockstep_script_run(lockstep_script* script, lockstep_entry_value* values,
                         lockstep_entry_value* result) {
  return guarded([&] {
    if (script == nullptr || (values == nullptr && !script->entries.empty())) {
      return fail("an argument is NULL");
    }
    return run(*script, values, result);
  });
}
