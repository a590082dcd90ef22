#include "expression/change.h"

namespace lockstep::host {
namespace {

std::optional<double> constant(const Instruction& it) {
  double number = it.real;
  if (it.operation == Operation::Real) return number;
  const bool is_exact = it.operation == Operation::Whole && take_exactly(it.whole, number);
  return is_exact ? std::optional(number) : std::nullopt;
}

bool is_one_of(Operation operation, Operation first, Operation last) {
  return operation >= first && operation <= last;
}

}  // namespace

// Need n, LoadCopy n, constant, Add, Store n, End; or Need n, constant, AddTo n, End.
std::optional<Change> only_change(const std::vector<Instruction>& code) {
  const bool is_whole = code.size() == 6 && code[1].operation == Operation::LoadCopy;
  if ((!is_whole && code.size() != 4) || code[0].operation != Operation::Need) return std::nullopt;
  const std::size_t at = is_whole ? 2 : 1;
  const auto by = constant(code[at]);
  const Operation operation = code[at + 1].operation;
  const bool is_change = is_whole ? is_one_of(operation, Operation::Add, Operation::Divide) &&
                                        code[4].operation == Operation::Store &&
                                        code[1].argument == code[0].argument
                                  : is_one_of(operation, Operation::AddTo, Operation::DivideBy);
  return by && is_change ? std::optional(Change{operation, *by}) : std::nullopt;
}

}  // namespace lockstep::host
