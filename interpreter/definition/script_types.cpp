#include "definition/script_types.h"

#include <map>
#include <vector>

namespace lockstep {
namespace {

bool is_text(const StaticType& type) {
  return type.type == ValueType::String;
}

// Runs the program of a script over types.
class TypeMachine {
 public:
  TypeMachine(const Expression& script, std::span<const StaticType> entries,
              const Assigned& assigned)
      : entries_(entries), assigned_(assigned), code_(script.program().code) {}

  void run() {
    for (std::uint32_t at = 0; code_[at].operation != Operation::End; ++at) {
      join_ways(at);
      step(code_[at]);
    }
  }

 private:
  void step(const Instruction& it) {
    switch (it.operation) {
      case Operation::Real:
        return push(ValueType::Double);
      case Operation::Truth:
        return push(ValueType::Bool);
      case Operation::Whole:
        return push(ValueType::Int);
      case Operation::Text:
        return push(ValueType::String);
      case Operation::Load:
      case Operation::LoadCopy:
        return stack_.push_back(entries_[it.argument]);
      case Operation::Add:
        return add();
      case Operation::Subtract:
      case Operation::Multiply:
      case Operation::Divide:
      case Operation::BitAnd:
      case Operation::BitOr:
      case Operation::BitXor:
        return combine(ValueType::Double);
      case Operation::Join:
        return combine(ValueType::String);
      case Operation::And:
      case Operation::Or:
      case Operation::Compare:
        return combine(ValueType::Bool);
      case Operation::Negate:
      case Operation::Complement:
        return replace(ValueType::Double);
      case Operation::Not:
        return replace(ValueType::Bool);
      case Operation::CompareNext: {  // the right operand stays
        const StaticType right = pop();
        stack_.back() = right;
        return;
      }
      case Operation::Store:
      case Operation::AddTo:
      case Operation::SubtractFrom:
      case Operation::MultiplyBy:
      case Operation::DivideBy:
        return assign(it);
      case Operation::Jump:
        ways_.emplace(it.argument, pop());
        return;
      case Operation::JumpIfZero:
      case Operation::Pop:
        pop();
        return;
      case Operation::Make:
      case Operation::Need:
      case Operation::NoTarget:
      case Operation::End:
        return;
    }
  }

  // A '?' has two ways to what follows it.
  void join_ways(std::uint32_t at) {
    for (auto [way, end] = ways_.equal_range(at); way != end; ++way) {
      if (way->second == stack_.back()) continue;
      const bool both_numbers = is_numeric(way->second) && is_numeric(stack_.back());
      stack_.back() = {both_numbers ? std::optional(ValueType::Double) : std::nullopt};
    }
  }

  static bool is_numeric(const StaticType& type) {
    return type.type == ValueType::Int || type.type == ValueType::Double;
  }

  void add() {
    const StaticType right = pop();
    const bool joins = is_text(right) || is_text(stack_.back());
    const bool is_known = right.type.has_value() || stack_.back().type.has_value();
    replace(joins ? ValueType::String : ValueType::Double);
    if (!is_known) stack_.back() = {};
  }

  void assign(const Instruction& it) {
    if (it.argument >= entries_.size()) return;  // its left side is no name
    const StaticType& entry = entries_[it.argument];
    if (it.operation == Operation::Store) assigned_(it.argument, stack_.back());
    if (entry.type) stack_.back() = entry;
  }

  void combine(ValueType type) {
    pop();
    replace(type);
  }
  void replace(ValueType type) { stack_.back() = {type}; }
  void push(ValueType type) { stack_.push_back({type}); }
  StaticType pop() {
    const StaticType top = stack_.back();
    stack_.pop_back();
    return top;
  }

  std::span<const StaticType> entries_;
  const Assigned& assigned_;
  std::span<const Instruction> code_;
  std::vector<StaticType> stack_;
  std::multimap<std::uint32_t, StaticType> ways_;  // to an instruction: what they leave
};

}  // namespace

void find_assignments(const Expression& script, std::span<const StaticType> entries,
                      const Assigned& assigned) {
  TypeMachine(script, entries, assigned).run();
}

}  // namespace lockstep
