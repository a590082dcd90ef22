#include "expression/operator_words.h"

namespace lockstep::host {

std::string_view sign_of(Operation operation, Relation relation) {
  constexpr std::string_view kRelations[] = {"==", "!=", "<", "<=", ">", ">="};
  switch (operation) {
    case Operation::Add:
      return "+";
    case Operation::Subtract:
    case Operation::Negate:
      return "-";
    case Operation::Multiply:
      return "*";
    case Operation::Divide:
      return "/";
    case Operation::Join:
      return "..";
    case Operation::BitAnd:
      return "&";
    case Operation::BitOr:
      return "|";
    case Operation::BitXor:
      return "^";
    case Operation::And:
      return "&&";
    case Operation::Or:
      return "||";
    case Operation::Complement:
      return "~";
    case Operation::Not:
      return "!";
    case Operation::AddTo:
      return "+=";
    case Operation::SubtractFrom:
      return "-=";
    case Operation::MultiplyBy:
      return "*=";
    case Operation::DivideBy:
      return "/=";
    case Operation::JumpIfZero:
      return "?";
    default:
      return kRelations[static_cast<unsigned>(relation)];
  }
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
      return "two conditions: 0, 1 or a number that is not negative and not whole";
    case Operation::Compare:
    case Operation::CompareNext:
      return "two numbers or two texts, or a number and the text of one";
    case Operation::Negate:
    case Operation::Not:
    case Operation::JumpIfZero:
      return "a number";
    case Operation::Complement:
      return "a number of at most 63 bits";
    default:
      return "two numbers";
  }
}

}  // namespace lockstep::host
