#include "expression.hpp"

#include <algorithm>
#include <cmath>

#include "field_values.hpp"

namespace ros2 {
namespace {

using What = Expression::Step::What;

// Of what is not known, nothing is known.
double combined(What what, double one, double other) {
  if (std::isnan(one) || std::isnan(other)) return NAN;
  switch (what) {
    case What::Add:
      return one + other;
    case What::Subtract:
      return one - other;
    case What::Multiply:
      return one * other;
    case What::Divide:
      return other == 0 ? NAN : one / other;
    case What::Least:
      return std::min(one, other);
    case What::Less:
      return one < other ? 1 : 0;
    case What::LessOrEqual:
      return one <= other ? 1 : 0;
    case What::Equal:
      return one == other ? 1 : 0;
    case What::And:
      return one != 0 && other != 0 ? 1 : 0;
    case What::Or:
      return one != 0 || other != 0 ? 1 : 0;
    default:
      return std::max(one, other);
  }
}

double input_of(const Expression::Step& step, const Expression::Inputs& inputs) {
  const Expression::Source& source = step.is_of_second ? inputs.second : inputs.first;
  const Field& field = (*source.fields)[step.index];
  const void* const message = source.message;
  const auto value = step.what == What::Size ? size_in(field, message) : number_in(field, message);
  return value.value_or(NAN);
}

}  // namespace

bool Expression::uses_second() const {
  return std::any_of(steps_.begin(), steps_.end(), [](const Step& step) {
    const bool is_input = step.what == What::Field || step.what == What::Size;
    return is_input && step.is_of_second;
  });
}

std::optional<double> Expression::value(const Inputs& inputs, Memory& memory) const {
  constexpr std::size_t kDeepest = 200;  // the reader refuses what needs more
  double stack[kDeepest + 1];
  std::size_t depth = 0;
  for (const Step& step : steps_) {
    switch (step.what) {
      case What::Number:
        stack[depth++] = step.number;
        break;
      case What::Field:
      case What::Size:
        stack[depth++] = input_of(step, inputs);
        break;
      case What::Given:
        stack[depth++] = inputs.given;
        break;
      case What::First:
        if (!memory[step.index] && std::isfinite(stack[depth - 1])) {
          memory[step.index] = stack[depth - 1];
        }
        stack[depth - 1] = memory[step.index].value_or(NAN);
        break;
      case What::Negate:
        stack[depth - 1] = -stack[depth - 1];
        break;
      case What::Not:
        if (!std::isnan(stack[depth - 1])) stack[depth - 1] = stack[depth - 1] == 0 ? 1 : 0;
        break;
      default:
        --depth;
        stack[depth - 1] = combined(step.what, stack[depth - 1], stack[depth]);
    }
  }
  if (depth != 1 || !std::isfinite(stack[0])) return std::nullopt;
  return stack[0];
}

}  // namespace ros2
