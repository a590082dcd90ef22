#include "language/expression/equal.h"

#include "language/expression/assign.h"
#include "language/expression/operand.h"

namespace lockstep::host {

bool equals_text(const Value& value, const std::string& text) {
  const Operand operand = Operand::of(value);
  if (operand.kind == Operand::Kind::Text) return *operand.text == text;
  if (!operand.is_number()) return false;
  const bool is_real = operand.kind == Operand::Kind::Real;
  const double number = is_real ? operand.real : static_cast<double>(operand.whole);
  const auto other = number_in_script(text, nullptr);
  return other && is_equal(number, *other);
}

}  // namespace lockstep::host
