// Runs expressions. One for each run: it keeps its stack, so that it allocates for texts that are
// longer than all before only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/blackboard/entry.h"
#include "language/expression/expression.h"
#include "language/expression/operand.h"

namespace lockstep::host {

// For a condition.
enum class Truth : std::uint8_t { No, Yes, Error };

class Evaluator {
 public:
  static constexpr std::size_t kLongestText = std::size_t{1}
                                              << 20;  // that a script makes, in bytes

  // `entries`: of each of the expression's names(). False after an error; what was assigned before
  // it stays. `result`: the value of the last statement, which may be none.
  bool evaluate(const Expression& expression, std::span<Entry* const> entries, Value& result);
  // The same, when nobody asks for the result.
  bool execute(const Expression& expression, std::span<Entry* const> entries);
  // The same, of an expression that is a condition.
  Truth test(const Expression& expression, std::span<Entry* const> entries);
  // The error of the last script that failed.
  const std::string& error() const { return error_; }
  // For an error before that: keeps it and gives false.
  bool fail(std::string message) {
    error_ = std::move(message);
    return false;
  }

 private:
  // The value of the last statement; null after an error.
  const Operand* run(const Expression& expression, std::span<Entry* const> entries);

  std::string error_;
  std::vector<Operand> stack_;
  std::vector<std::string> texts_;  // those that were made for the operand at that place
};

}  // namespace lockstep::host
