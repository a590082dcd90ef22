#include "language/expression/reading_uses.h"

#include <set>

namespace lockstep::host {
namespace {

// Runs a program over what its operands are: the progress of a node, a number, or something else.
class UseFinder {
 public:
  explicit UseFinder(const Expression& script) : script_(script) {}

  std::vector<ProgressUse> find() {
    const auto& code = script_.program().code;
    for (std::uint32_t at = 0; at < code.size(); ++at) {
      if (joins_.contains(at)) replace();
      step(code[at]);
    }
    return std::move(uses_);
  }

 private:
  struct Operand {
    std::optional<std::uint32_t> reading = {};
    std::optional<double> number = {};
  };

  void step(const Instruction& it) {
    switch (it.operation) {
      case Operation::Real:
        return stack_.push_back({.number = it.real});
      case Operation::Whole:
        return stack_.push_back({.number = static_cast<double>(it.whole)});
      case Operation::Truth:
      case Operation::Text:
      case Operation::LoadShown:
        return stack_.push_back({});
      case Operation::Load:
      case Operation::LoadCopy:
      case Operation::LoadToCompare:
        return load(it.argument);
      case Operation::Compare:
        compare();
        stack_.back() = {};
        return;
      case Operation::CompareNext:
        return compare();
      case Operation::Make:
      case Operation::Need:
      case Operation::NoTarget:
        return;
      case Operation::Pop:
        stack_.pop_back();
        return;
      case Operation::Jump:
        joins_.insert(it.argument);
        [[fallthrough]];
      case Operation::JumpIfZero:
        replace();
        stack_.pop_back();
        return;
      case Operation::Negate:
      case Operation::Complement:
      case Operation::Not:
      case Operation::Store:
      case Operation::AddTo:
      case Operation::SubtractFrom:
      case Operation::MultiplyBy:
      case Operation::DivideBy:
      case Operation::End:
        return replace();
      default:  // of two
        replace();
        stack_.pop_back();
        return replace();
    }
  }

  void load(std::uint32_t argument) {
    stack_.emplace_back();
    if (argument < script_.names().size()) return;
    const auto reading = static_cast<std::uint32_t>(argument - script_.names().size());
    if (script_.readings()[reading].what == Reading::What::Progress) {
      stack_.back().reading = reading;
    }
  }

  // Leaves the right one, which a chain compares with the next.
  void compare() {
    const Operand right = stack_.back();
    stack_.pop_back();
    const Operand left = stack_.back();
    stack_.back() = right;
    if (left.reading) uses_.push_back({*left.reading, right.number});
    if (right.reading) uses_.push_back({*right.reading, left.number});
  }

  // The last operand is used otherwise, or may be one of two.
  void replace() {
    if (stack_.back().reading) uses_.push_back({*stack_.back().reading, {}});
    stack_.back() = {};
  }

  const Expression& script_;
  std::vector<Operand> stack_;
  std::set<std::uint32_t> joins_;
  std::vector<ProgressUse> uses_;
};

}  // namespace

std::vector<ProgressUse> progress_uses(const Expression& script) {
  return UseFinder(script).find();
}

}  // namespace lockstep::host
