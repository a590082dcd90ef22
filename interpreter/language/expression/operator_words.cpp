#include "language/expression/operator_words.h"

#include <algorithm>
#include <iterator>

namespace lockstep::host {

namespace {

struct Sign {
  Operation operation;
  std::string_view sign;
};
constexpr Sign kSigns[] = {
    {Operation::Add, "+"},         {Operation::Subtract, "-"},  {Operation::Negate, "-"},
    {Operation::Multiply, "*"},    {Operation::Divide, "/"},    {Operation::Join, ".."},
    {Operation::BitAnd, "&"},      {Operation::BitOr, "|"},     {Operation::BitXor, "^"},
    {Operation::And, "&&"},        {Operation::Or, "||"},       {Operation::Complement, "~"},
    {Operation::Not, "!"},         {Operation::AddTo, "+="},    {Operation::SubtractFrom, "-="},
    {Operation::MultiplyBy, "*="}, {Operation::DivideBy, "/="}, {Operation::JumpIfZero, "?"},
};
constexpr std::string_view kRelations[] = {"==", "!=", "<", "<=", ">", ">="};

}  // namespace

std::string_view sign_of(Operation operation, Relation relation) {
  const auto* const found = std::ranges::find(kSigns, operation, &Sign::operation);
  return found == std::end(kSigns) ? kRelations[static_cast<unsigned>(relation)] : found->sign;
}

std::string_view operands_of(Operation operation) {
  switch (operation) {
    case Operation::Add:
    case Operation::AddTo:
      return "two numbers or two texts";
    case Operation::Join:
      return "two texts, or a text and a number";
    case Operation::BitAnd:
    case Operation::BitOr:
    case Operation::BitXor:
      return "two whole numbers";
    case Operation::And:
    case Operation::Or:
      return "two conditions: true, false, 0, 1 or a number that is not negative and not whole";
    case Operation::Compare:
    case Operation::CompareNext:
      return "two numbers or two texts, or a number and the text of one";
    case Operation::Negate:
      return "a number";
    case Operation::Not:
    case Operation::JumpIfZero:
      return "a number, true or false";
    case Operation::Complement:
      return "a number of at most 63 bits";
    default:
      return "two numbers";
  }
}

}  // namespace lockstep::host
