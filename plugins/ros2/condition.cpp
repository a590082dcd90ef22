#include "condition.hpp"

namespace ros2 {

bool Condition::read(const FixedTexts& texts, const lockstep_port& port, const std::string& prefix,
                     const std::vector<Field>& fields, Refusal& refusal) {
  text_ = texts[port];
  if (text_.empty()) return true;
  fields_ = &fields;
  auto expression = read_condition(text_, prefix, fields);
  if (expression) {
    expression_ = std::move(*expression);
  } else {
    refusal = {&port, expression.problem()};
  }
  return bool(expression);
}

bool Condition::holds(const void* message, double elapsed, Expression::Memory& memory) const {
  if (!is_given()) return true;
  return expression_.value({{fields_, message}, {}, elapsed}, memory).value_or(0) != 0;
}

}  // namespace ros2
