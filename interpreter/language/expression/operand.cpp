#include "language/expression/operand.h"

#include <fmt/format.h>

#include <cmath>

#include "base/blackboard/conversion.h"
#include "base/core/wording.h"

namespace lockstep::host {

Value Operand::value() const {
  switch (kind) {
    case Kind::Whole:
      return whole;
    case Kind::Real:
      return real;
    case Kind::Text:
      return *text;
    case Kind::Other:
      return *other;
    case Kind::Empty:
      break;
  }
  return {};
}

std::string Operand::shown() const {
  switch (kind) {
    case Kind::Whole:
      if (whole > kLargestExact || whole < -kLargestExact) {
        return fmt::format("{} (beyond {})", whole, whole < 0 ? -kLargestExact : kLargestExact);
      }
      return fmt::format("{}", whole);
    case Kind::Real:
      if (std::isnan(real)) return "NaN (such as 0/0)";  // fmt shows the sign that it may have
      return fmt::format("{}", real);
    case Kind::Text:
      return fmt::format("the text '{}'", brief(*text));
    case Kind::Other:
      return fmt::format("the {} of an entry", to_string(static_cast<ValueType>(other->index())));
    case Kind::Empty:
      break;
  }
  return "an entry without a value";
}

}  // namespace lockstep::host
