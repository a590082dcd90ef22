// Entries by name, and scripts that run on them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/blackboard/entry.h"
#include "language/expression/evaluator.h"

namespace lockstep::host::test {

// What a script made of its entries.
struct ScriptRun {
  Value value = {};
  std::string error = {};  // "" if there is none
};

class ScriptBoard {
 public:
  explicit ScriptBoard(std::shared_ptr<const ScriptEnums> enums = nullptr)
      : enums_(std::move(enums)) {}

  // An entry of a type that a port gave it.
  Entry& declare(const std::string& name, ValueType type, Value value = {},
                 Typing typing = Typing::Declared);
  // An entry without a type.
  Entry& any(const std::string& name, Value value = {});
  // As it is; a name that nothing has named is an entry that does not exist.
  Entry& at(const std::string& name);

  // The text must be a script.
  ScriptRun run(std::string_view script);

 private:
  std::map<std::string, Entry> entries_;
  std::shared_ptr<const ScriptEnums> enums_;
  Evaluator evaluator_;
};

// "5", "5.0", "'text'", "true", "none", "1;2".
std::string shown(const Value& value);

}  // namespace lockstep::host::test
