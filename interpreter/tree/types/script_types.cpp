#include "tree/types/script_types.h"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "language/expression/operator_words.h"
#include "tree/types/type_words.h"

namespace lockstep::host {
namespace {

enum class TypeKind : std::uint8_t { Unknown, Number, Text, Other };

TypeKind kind_of(const StaticType& type) {
  if (!type.type) return TypeKind::Unknown;
  switch (*type.type) {
    case ValueType::Bool:
    case ValueType::Int:
    case ValueType::Double:
    case ValueType::Number:
      return TypeKind::Number;
    case ValueType::String:
      return TypeKind::Text;
    default:
      return TypeKind::Other;
  }
}
bool is_number(const StaticType& type) {
  return kind_of(type) == TypeKind::Number;
}
bool is_text(const StaticType& type) {
  return kind_of(type) == TypeKind::Text;
}
bool is_other(const StaticType& type) {
  return kind_of(type) == TypeKind::Other;
}
bool may_be_a_number(const StaticType& type) {
  return !is_text(type) && !is_other(type);
}

std::string shown(const StaticType& type) {
  return type.type ? with_article(*type.type, type.object) : std::string("a value");
}

bool fit(Operation operation, const StaticType& left, const StaticType& right) {
  if (is_other(left) || is_other(right)) return false;
  switch (operation) {
    case Operation::Add:
    case Operation::AddTo:
      return !(is_text(left) && is_number(right)) && !(is_number(left) && is_text(right));
    case Operation::Join:
      return !is_number(left) || !is_number(right);
    case Operation::Compare:
    case Operation::CompareNext:
      return true;
    default:
      return may_be_a_number(left) && may_be_a_number(right);
  }
}

// Runs the program of a script over types.
class TypeMachine {
 public:
  TypeMachine(const Expression& script, std::span<const StaticType> entries,
              const TypeListener& listener)
      : script_(script), entries_(entries), listener_(listener), code_(script.program().code) {}

  StaticType run() {
    for (at_ = 0; code_[at_].operation != Operation::End; ++at_) {
      join_ways();
      step(code_[at_]);
    }
    join_ways();
    return stack_.back();
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
      case Operation::LoadShown:
        return push(ValueType::String);
      case Operation::Load:
      case Operation::LoadCopy:
      case Operation::LoadToCompare:
        if (it.argument < entries_.size()) return stack_.push_back(entries_[it.argument]);
        return push(row_of(script_.readings()[it.argument - entries_.size()].what).type);
      case Operation::Add:
        return add(it);
      case Operation::Subtract:
      case Operation::Multiply:
      case Operation::Divide:
      case Operation::BitAnd:
      case Operation::BitOr:
      case Operation::BitXor:
        return combine(it, ValueType::Double);
      case Operation::Join:
        return combine(it, ValueType::String);
      case Operation::And:
      case Operation::Or:
      case Operation::Compare:
        return combine(it, ValueType::Bool);
      case Operation::CompareNext:
        return compare_next(it);
      case Operation::Negate:
      case Operation::Complement:
        return change(it, ValueType::Double);
      case Operation::Not:
        return change(it, ValueType::Bool);
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
  void join_ways() {
    for (auto [way, end] = ways_.equal_range(at_); way != end; ++way) {
      if (way->second == stack_.back()) continue;
      const bool both = is_number(way->second) && is_number(stack_.back());
      stack_.back() = {both ? std::optional(ValueType::Double) : std::nullopt};
    }
  }

  void add(const Instruction& it) {
    const StaticType right = pop(), left = stack_.back();
    check(it, left, right);
    const bool joins = is_text(right) || is_text(left);
    replace(joins ? ValueType::String : ValueType::Double);
    if (!right.type && !left.type) stack_.back() = {};
  }

  void combine(const Instruction& it, ValueType type) {
    const StaticType right = pop();
    check(it, stack_.back(), right);
    replace(type);
  }

  void compare_next(const Instruction& it) {
    const StaticType right = pop();
    check(it, stack_.back(), right);
    stack_.back() = right;
  }

  void change(const Instruction& it, ValueType type) {
    if (!may_be_a_number(stack_.back())) {
      wrong(fmt::format("'{}' takes {}, not {}", sign_of(it.operation, it.relation),
                        operands_of(it.operation), shown(stack_.back())));
    }
    replace(type);
  }

  void check(const Instruction& it, const StaticType& left, const StaticType& right) const {
    if (fit(it.operation, left, right)) return;
    wrong(fmt::format("'{}' takes {}, not {} and {}", sign_of(it.operation, it.relation),
                      operands_of(it.operation), shown(left), shown(right)));
  }

  void assign(const Instruction& it) {
    if (it.argument >= entries_.size()) return;  // its left side is no name
    const StaticType& entry = entries_[it.argument];
    if (it.operation != Operation::Store) {
      check(it, entry, stack_.back());
    } else if (!takes(entry, stack_.back())) {
      wrong(fmt::format("cannot assign {} to '{}', which is {}", shown(stack_.back()),
                        script_.names()[it.argument], shown(entry)));
    } else {
      listener_.assigned(it.argument, stack_.back());
    }
    if (entry.type) stack_.back() = entry;
  }

  // A text may be that of a number.
  static bool takes(const StaticType& entry, const StaticType& value) {
    if (!entry.type || !value.type) return true;
    if (is_other(entry) || is_other(value)) return entry == value;
    return !is_text(entry) || is_text(value);
  }

  void wrong(std::string message) const {
    listener_.wrong(script_.offsets()[at_], std::move(message));
  }
  void replace(ValueType type) { stack_.back() = {type}; }
  void push(ValueType type) { stack_.push_back({type}); }
  StaticType pop() {
    const StaticType top = stack_.back();
    stack_.pop_back();
    return top;
  }

  const Expression& script_;
  std::span<const StaticType> entries_;
  const TypeListener& listener_;
  std::span<const Instruction> code_;
  std::uint32_t at_ = 0;
  std::vector<StaticType> stack_;
  std::multimap<std::uint32_t, StaticType> ways_;  // to an instruction: what they leave
};

}  // namespace

StaticType infer_types(const Expression& script, std::span<const StaticType> entries,
                       const TypeListener& listener) {
  return TypeMachine(script, entries, listener).run();
}

bool may_be_yes_or_no(const StaticType& type) {
  return may_be_a_number(type);
}

}  // namespace lockstep::host
