#include "expression/evaluator.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/conversion.h"
#include "core/wording.h"
#include "expression/assign.h"
#include "expression/equal.h"
#include "expression/operator_words.h"

namespace lockstep {
namespace {

// NaN is neither "less or equal" nor "more or equal", and so both less and more.
bool are_related(double left, Relation relation, double right) {
  switch (relation) {
    case Relation::Equal:
      return is_equal(left, right);
    case Relation::NotEqual:
      return !is_equal(left, right);
    case Relation::LessEqual:
      return left < right || is_equal(left, right);
    case Relation::GreaterEqual:
      return left > right || is_equal(left, right);
    case Relation::Less:
      return !are_related(left, Relation::GreaterEqual, right);
    case Relation::Greater:
      break;
  }
  return !are_related(left, Relation::LessEqual, right);
}

bool are_related(const std::string& left, Relation relation, const std::string& right) {
  switch (relation) {
    case Relation::Equal:
      return left == right;
    case Relation::NotEqual:
      return left != right;
    case Relation::Less:
      return left < right;
    case Relation::LessEqual:
      return left <= right;
    case Relation::Greater:
      return left > right;
    case Relation::GreaterEqual:
      break;
  }
  return left >= right;
}

// The number that an operand has, if it is one and has it exactly.
bool take(const Operand& operand, double& number) {
  if (operand.kind == Operand::Kind::Real) {
    number = operand.real;
    return true;
  }
  const bool is_exact = operand.kind == Operand::Kind::Whole && operand.whole <= kLargestExact &&
                        operand.whole >= -kLargestExact;
  if (is_exact) number = static_cast<double>(operand.whole);
  return is_exact;
}

bool take(const Operand& operand, std::int64_t& number) {
  if (operand.kind == Operand::Kind::Real) {
    const auto whole = to_whole(operand.real);
    number = whole.value_or(0);
    return whole.has_value();
  }
  number = operand.whole;
  return operand.kind == Operand::Kind::Whole;
}

bool take(const Operand& operand, bool& holds) {
  if (operand.kind == Operand::Kind::Real) {
    holds = operand.real != 0;
    return !(operand.real < 0);
  }
  holds = operand.whole == 1;
  return operand.kind == Operand::Kind::Whole && (operand.whole == 0 || operand.whole == 1);
}

// One run of one expression.
class Machine {
 public:
  Machine(const Expression& expression, std::span<Entry* const> entries, Operand* stack,
          std::string* texts)
      : expression_(expression),
        program_(expression.program()),
        entries_(entries),
        stack_(stack),
        texts_(texts) {}

  // The stack then has the value of the last statement, or error() says why not.
  bool run() {
    for (const Instruction* at = program_.code.data(); at->operation != Operation::End;) {
      it_ = at;
      next_ = at + 1;
      if (!step()) return false;
      at = next_;
    }
    return true;
  }
  std::string& error() { return error_; }

 private:
  bool step() {
    switch (it_->operation) {
      case Operation::Real:
        return push(Operand::of(program_.reals[it_->argument]));
      case Operation::Whole:
        return push(Operand::of(program_.wholes[it_->argument]));
      case Operation::Text:
        return push(Operand::of(&program_.texts[it_->argument]));
      case Operation::Truth:
        return push(Operand::of(static_cast<double>(it_->argument)));
      case Operation::Load:
        return load();
      case Operation::LoadCopy:
        return load() && copy_text();
      case Operation::Add:
      case Operation::Subtract:
      case Operation::Multiply:
      case Operation::Divide:
        return calculate();
      case Operation::Join:
        return join();
      case Operation::BitAnd:
      case Operation::BitOr:
      case Operation::BitXor:
        return combine_bits();
      case Operation::And:
      case Operation::Or:
        return combine_conditions();
      case Operation::Compare:
      case Operation::CompareNext:
        return compare();
      case Operation::Negate:
      case Operation::Complement:
      case Operation::Not:
        return change_one();
      case Operation::JumpIfZero:
        return branch();
      case Operation::Jump:
        return go_to(it_->argument);
      case Operation::Pop:
        --top_;
        return true;
      default:
        return assign_step();
    }
  }

  bool assign_step() {
    switch (it_->operation) {
      case Operation::Make:
        if (!entry().is_present) make_entry(entry(), Typing::Any);
        return true;
      case Operation::Need:
        return entry().is_present || no_entry();
      case Operation::NoTarget:
        return fail("the left side of an assignment is not a name");
      case Operation::Store:
        return store(last());
      default:
        return store_changed();
    }
  }

  bool push(const Operand& operand) {
    stack_[top_++] = operand;
    return true;
  }
  Operand& last() { return stack_[top_ - 1]; }
  Operand& before_last() { return stack_[top_ - 2]; }
  Entry& entry() { return *entries_[it_->argument]; }
  const std::string& name() const { return expression_.names()[it_->argument]; }

  bool go_to(std::uint32_t instruction) {
    next_ = program_.code.data() + instruction;
    return true;
  }

  bool fail(std::string message) {
    error_ = std::move(message);
    return false;
  }
  bool wrong_operand(const Operand& operand) {
    return fail(fmt::format("'{}' takes {}, not {}", sign_of(it_->operation, it_->relation),
                            operands_of(it_->operation), operand.shown()));
  }
  bool wrong_operands(const Operand& left, const Operand& right) {
    return fail(fmt::format("'{}' takes {}, not {} and {}", sign_of(it_->operation, it_->relation),
                            operands_of(it_->operation), left.shown(), right.shown()));
  }
  bool wrong_operands() { return wrong_operands(before_last(), last()); }
  bool no_entry() {
    return fail(
        fmt::format("there is no entry '{}'; '{} := …' makes it", brief(name()), brief(name())));
  }

  bool load() {
    const Entry& from = entry();
    if (!from.is_present) return no_entry();
    return push(Operand::of(from.value));
  }

  // The text made for the operand at `place`.
  std::string& text_at(std::size_t place) { return texts_[place]; }

  bool copy_text() {
    if (last().kind != Operand::Kind::Text) return true;
    std::string& own = text_at(top_ - 1);
    own = *last().text;
    last().text = &own;
    return true;
  }

  bool replace_two(const Operand& result) {
    --top_;
    last() = result;
    return true;
  }

  static double calculated(double left, Operation operation, double right) {
    switch (operation) {
      case Operation::Add:
      case Operation::AddTo:
        return left + right;
      case Operation::Subtract:
      case Operation::SubtractFrom:
        return left - right;
      case Operation::Multiply:
      case Operation::MultiplyBy:
        return left * right;
      default:
        return left / right;
    }
  }

  bool calculate() {
    double left = 0;
    double right = 0;
    if (take(before_last(), left) && take(last(), right)) {
      return replace_two(Operand::of(calculated(left, it_->operation, right)));
    }
    const bool are_texts =
        before_last().kind == Operand::Kind::Text && last().kind == Operand::Kind::Text;
    if (it_->operation == Operation::Add && are_texts) return join_here();
    return wrong_operands();
  }

  bool join() {
    const bool has_text =
        before_last().kind == Operand::Kind::Text || last().kind == Operand::Kind::Text;
    const auto is_part = [](const Operand& it) {
      return it.kind == Operand::Kind::Text || it.is_number();
    };
    if (!has_text || !is_part(before_last()) || !is_part(last())) return wrong_operands();
    return join_here();
  }

  static void append(const Operand& operand, std::string& out) {
    if (operand.kind == Operand::Kind::Text) out += *operand.text;
    if (operand.kind == Operand::Kind::Whole) append_plain(operand.whole, out);
    if (operand.kind == Operand::Kind::Real) append_plain(operand.real, out);
  }

  bool join_here() {
    std::string& joined = text_at(top_ - 2);
    const Operand left = before_last();
    if (left.kind != Operand::Kind::Text || left.text != &joined) {
      joined.clear();
      append(left, joined);
    }
    append(last(), joined);
    return check_length(joined) && replace_two(Operand::of(&joined));
  }

  // A tree that appends in every tick must not fill the memory.
  bool check_length(const std::string& joined) {
    if (joined.size() <= Evaluator::kLongestText) return true;
    return fail(fmt::format("'{}' makes a text of more than {} bytes",
                            sign_of(it_->operation, it_->relation), Evaluator::kLongestText));
  }

  bool combine_bits() {
    std::int64_t left = 0;
    std::int64_t right = 0;
    if (!take(before_last(), left) || !take(last(), right)) return wrong_operands();
    std::int64_t bits = left ^ right;
    if (it_->operation == Operation::BitAnd) bits = left & right;
    if (it_->operation == Operation::BitOr) bits = left | right;
    return replace_two(Operand::of(static_cast<double>(bits)));
  }

  bool combine_conditions() {
    bool left = false;
    bool right = false;
    if (!take(before_last(), left) || !take(last(), right)) return wrong_operands();
    const bool holds = it_->operation == Operation::And ? left && right : left || right;
    return replace_two(Operand::of(holds ? 1.0 : 0.0));
  }

  bool take_comparable(const Operand& operand, double& number) const {
    if (operand.kind != Operand::Kind::Text) return take(operand, number);
    const auto found = number_in_script(*operand.text, expression_.enums());
    number = found.value_or(0);
    return found.has_value();
  }

  bool compare() {
    const Operand& left = before_last();
    const Operand& right = last();
    bool holds = false;
    if (left.kind == Operand::Kind::Text && right.kind == Operand::Kind::Text) {
      holds = are_related(*left.text, it_->relation, *right.text);
    } else {
      double first = 0;
      double second = 0;
      if (!take_comparable(left, first) || !take_comparable(right, second)) {
        return wrong_operands();
      }
      holds = are_related(first, it_->relation, second);
    }
    if (it_->operation == Operation::Compare || !holds) {
      replace_two(Operand::of(holds ? 1.0 : 0.0));
      return it_->operation == Operation::Compare || go_to(it_->argument);
    }
    keep_right();
    return true;
  }

  // The text of the operand moves with it.
  void keep_right() {
    --top_;
    const Operand right = stack_[top_];
    last() = right;
    if (right.kind != Operand::Kind::Text || right.text != &text_at(top_)) return;
    std::swap(text_at(top_ - 1), text_at(top_));
    last().text = &text_at(top_ - 1);
  }

  bool change_one() {
    double number = 0;
    if (!take(last(), number)) return wrong_operand(last());
    if (it_->operation == Operation::Complement) {
      const auto whole = to_whole(std::trunc(number));
      if (!whole) return wrong_operand(last());
      last() = Operand::of(static_cast<double>(~*whole));
    } else if (it_->operation == Operation::Not) {
      last() = Operand::of(number != 0 ? 0.0 : 1.0);
    } else {
      last() = Operand::of(-number);
    }
    return true;
  }

  bool branch() {
    double number = 0;
    bool is_number = take(last(), number);
    if (last().kind == Operand::Kind::Text) {
      const auto found = number_from_text(*last().text);
      is_number = found.has_value();
      if (found) number = found->value;
    }
    if (!is_number) return wrong_operand(last());
    --top_;
    return number != 0 || go_to(it_->argument);
  }

  // The value of an assignment is what the entry then has.
  bool store(const Operand& value) {
    error_ = assign(entry(), value, expression_.enums(), name());
    if (!error_.empty()) return false;
    last() = Operand::of(entry().value);
    return copy_text();
  }

  bool store_changed() {
    if (!entry().is_present) return no_entry();
    const Operand old = Operand::of(entry().value);
    double left = 0;
    double right = 0;
    if (take(old, left) && take(last(), right)) {
      return store(Operand::of(calculated(left, it_->operation, right)));
    }
    const bool are_texts = old.kind == Operand::Kind::Text && last().kind == Operand::Kind::Text;
    if (it_->operation != Operation::AddTo || !are_texts) return wrong_operands(old, last());
    std::string& joined = text_at(top_);
    joined = *old.text;
    joined += *last().text;
    return check_length(joined) && store(Operand::of(&joined));
  }

  const Expression& expression_;
  const ScriptProgram& program_;
  const std::span<Entry* const> entries_;
  Operand* const stack_;
  std::string* const texts_;
  std::size_t top_ = 0;
  const Instruction* it_ = nullptr;
  const Instruction* next_ = nullptr;
  std::string error_;
};

}  // namespace

std::string Evaluator::evaluate(const Expression& expression, std::span<Entry* const> entries,
                                Value& result) {
  Operand last;
  std::string error = run(expression, entries, last);
  if (error.empty()) last.store(result);
  return error;
}

std::string Evaluator::test(const Expression& expression, std::span<Entry* const> entries,
                            bool& holds) {
  Operand last;
  std::string error = run(expression, entries, last);
  if (!error.empty()) return error;
  if (take(last, holds)) return {};
  return fmt::format("a condition is 0, 1 or a number that is not negative and not whole, not {}",
                     last.shown());
}

std::string Evaluator::run(const Expression& expression, std::span<Entry* const> entries,
                           Operand& last) {
  const std::size_t size = expression.program().stack + std::size_t{1};
  if (stack_.size() < size) {
    stack_.resize(size);
    texts_.resize(size);
  }
  Machine machine(expression, entries, stack_.data(), texts_.data());
  if (!machine.run()) return std::move(machine.error());
  last = stack_[0];
  return {};
}

}  // namespace lockstep
