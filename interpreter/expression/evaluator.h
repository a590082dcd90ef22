// Runs expressions. One for each run: it keeps its stack, so that it allocates for texts that are
// longer than all before only.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/entry.h"
#include "expression/expression.h"
#include "expression/operand.h"

namespace lockstep {

class Evaluator {
 public:
  static constexpr std::size_t kLongestText = std::size_t{1}
                                              << 20;  // that a script makes, in bytes

  // `entries`: of each of the expression's names(). Returns "" or the error; what was assigned
  // before it stays. `result`: the value of the last statement, which may be none.
  std::string evaluate(const Expression& expression, std::span<Entry* const> entries,
                       Value& result);
  // The same, of an expression that is a condition.
  std::string test(const Expression& expression, std::span<Entry* const> entries, bool& holds);

 private:
  std::string run(const Expression& expression, std::span<Entry* const> entries, Operand& last);

  std::vector<Operand> stack_;
  std::vector<std::string> texts_;  // those that were made for the operand at that place
};

}  // namespace lockstep
