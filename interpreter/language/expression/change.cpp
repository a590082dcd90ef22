#include "language/expression/change.h"

namespace lockstep::host {
namespace {

std::optional<double> constant(const Instruction& it) {
  double number = it.real;
  if (it.operation == Operation::Real) return number;
  const bool is_exact = it.operation == Operation::Whole && take_exactly(it.whole, number);
  return is_exact ? std::optional(number) : std::nullopt;
}

// The number that is added to a whole number, where nothing else happens.
std::optional<std::int64_t> step_of(Operation operation, double by) {
  if (!(std::fabs(by) <= static_cast<double>(kLargestExact))) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(by);
  if (static_cast<double>(whole) != by) return std::nullopt;
  if (operation == Operation::Add || operation == Operation::AddTo) return whole;
  const bool is_subtracted =
      operation == Operation::Subtract || operation == Operation::SubtractFrom;
  return is_subtracted ? std::optional(-whole) : std::nullopt;
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
  if (!by || !is_change) return std::nullopt;
  return Change{operation, *by, step_of(operation, *by)};
}

}  // namespace lockstep::host
