#include "expression/expression.h"

namespace lockstep {

tl::expected<Expression, Expression::Error> Expression::parse(std::string_view) {
  return Expression();
}

}  // namespace lockstep
