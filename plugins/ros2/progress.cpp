#include "progress.hpp"

#include <algorithm>
#include <cmath>

#include "field_values.hpp"

namespace ros2 {
namespace {

using What = Progress::Step::What;

double combined(What what, double one, double other) {
  switch (what) {
    case What::Add:
      return one + other;
    case What::Subtract:
      return one - other;
    case What::Multiply:
      return one * other;
    case What::Divide:
      return one / other;
    case What::Least:
      return std::min(one, other);
    default:
      return std::max(one, other);
  }
}

double input_of(const Progress::Step& step, const Progress::Inputs& inputs) {
  const Field& field =
      (step.is_of_goal ? *inputs.goal_fields : *inputs.feedback_fields)[step.index];
  const void* const message = step.is_of_goal ? inputs.goal : inputs.feedback;
  const auto value = step.what == What::Size ? size_in(field, message) : number_in(field, message);
  return value.value_or(NAN);
}

}  // namespace

bool Progress::uses_feedback() const {
  return std::any_of(steps_.begin(), steps_.end(), [](const Step& step) {
    const bool is_input = step.what == What::Field || step.what == What::Size;
    return is_input && !step.is_of_goal;
  });
}

std::optional<double> Progress::value(const Inputs& inputs, Memory& memory) const {
  constexpr std::size_t kDeepest = 128;  // the reader refuses what needs more
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
      case What::Elapsed:
        stack[depth++] = inputs.elapsed;
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
      default:
        --depth;
        stack[depth - 1] = combined(step.what, stack[depth - 1], stack[depth]);
    }
  }
  if (depth != 1 || !std::isfinite(stack[0])) return std::nullopt;
  return std::clamp(stack[0], 0.0, 1.0);
}

}  // namespace ros2
