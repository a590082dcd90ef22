#include "language/expression/evaluator.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/wording.h"
#include "language/expression/assign.h"
#include "language/expression/change.h"
#include "language/expression/operator_words.h"
#include "language/expression/relation.h"

namespace lockstep::host {
namespace {

bool are_related(const std::string& left, Relation relation, const std::string& right) {
  return are_related(static_cast<double>(left.compare(right)), relation, 0);
}

// The number that an operand has, if it is one and has it exactly.
bool take(const Operand& operand, double& number) {
  if (operand.kind == Operand::Kind::Real) {
    number = operand.real;
    return true;
  }
  return operand.kind == Operand::Kind::Whole && take_exactly(operand.whole, number);
}

bool take(const Operand& operand, std::int64_t& number) {
  double real = 0;
  if (!take(operand, real)) return false;
  const auto whole = to_whole(real);
  number = whole.value_or(0);
  return whole.has_value();
}

bool take(const Operand& operand, bool& holds) {
  if (operand.kind == Operand::Kind::Real) {
    holds = operand.real != 0;
    return !(operand.real < 0);
  }
  holds = operand.whole == 1;
  return operand.kind == Operand::Kind::Whole && (operand.whole == 0 || operand.whole == 1);
}

// A yes or no that came from outside may be a text.
bool take_condition(const Operand& operand, bool& holds) {
  if (operand.kind != Operand::Kind::Text) return take(operand, holds);
  const auto flag = parse_flag(*operand.text);
  holds = flag.value_or(false);
  return flag.has_value();
}

std::string without_value(std::string_view entry) {
  return fmt::format("the entry '{}' without a value", brief(entry));
}

// An operand is empty only if an entry was: the `nth` such entry, from `end` of the instructions
// back.
std::string described(const Operand& operand, const Expression& expression, Entry* const* entries,
                      const Instruction* end, int nth = 0) {
  if (operand.kind != Operand::Kind::Empty) return operand.shown();
  for (const Instruction* it = end; it-- != expression.program().code.data();) {
    const bool is_load = it->operation == Operation::Load || it->operation == Operation::LoadCopy ||
                         it->operation == Operation::LoadToCompare;
    if (!is_load || !std::holds_alternative<NoValue>(entries[it->argument]->value())) continue;
    if (nth-- == 0) return without_value(expression.names()[it->argument]);
  }
  return operand.shown();
}

// How far a program has run.
struct Reached {
  const Instruction* at;
  Operand* top;  // one past the last operand
};

// Runs what scripts do most, numbers, without a call. Stops before the first instruction that needs
// more: Machine does that one. They are separate so that this needs few registers.
[[gnu::noinline]] Reached run_quickly(const Instruction* at, Entry* const* entries, Operand* top) {
  double left = 0;
  double right = 0;
  for (;; ++at) {
    switch (at->operation) {
      case Operation::Load:
      case Operation::LoadCopy: {
        const Value& value = entries[at->argument]->value();
        if (const auto* real = std::get_if<double>(&value)) {
          *top++ = Operand::of(*real);
          continue;
        }
        if (const auto* whole = std::get_if<std::int64_t>(&value)) {
          *top++ = Operand::of(*whole);
          continue;
        }
        break;
      }
      case Operation::LoadToCompare:
        if (!take(entries[at->argument]->value(), left)) break;
        *top++ = Operand::of(are_related(left, at->relation, at->real) ? 1.0 : 0.0);
        at += 2;
        continue;
      case Operation::Real:
      case Operation::Truth:
        *top++ = Operand::of(at->real);
        continue;
      case Operation::Whole:
        *top++ = Operand::of(at->whole);
        continue;
      case Operation::Add:
      case Operation::Subtract:
      case Operation::Multiply:
      case Operation::Divide:
        if (!take(top[-2], left) || !take(top[-1], right)) break;
        --top;
        top[-1] = Operand::of(calculated(left, at->operation, right));
        continue;
      case Operation::Compare:
        if (!take(top[-2], left) || !take(top[-1], right)) break;
        --top;
        top[-1] = Operand::of(is_true(*at, left, right) ? 1.0 : 0.0);
        continue;
      case Operation::And:
      case Operation::Or: {
        bool first = false;
        bool second = false;
        if (!take(top[-2], first) || !take(top[-1], second)) break;
        --top;
        const bool holds = at->operation == Operation::And ? first && second : first || second;
        top[-1] = Operand::of(holds ? 1.0 : 0.0);
        continue;
      }
      case Operation::Need:
        if (!entries[at->argument]->is_present) break;
        continue;
      case Operation::Store: {
        Entry& entry = *entries[at->argument];
        if (!assign_number(entry, top[-1])) break;
        top[-1] = Operand::of(entry.value());
        continue;
      }
      default:
        break;
    }
    break;
  }
  return {at, top};
}

// One run of one expression: the instructions at which run_quickly stops, and no others.
class Machine {
 public:
  Machine(const Expression& expression, std::span<Entry* const> entries, Operand* stack,
          std::string* texts, std::string& error)
      : expression_(expression),
        program_(expression.program()),
        entries_(entries.data()),
        stack_(stack),
        texts_(texts),
        error_(error) {}

  // From there on. The stack then has the value of the last statement, or the error says why not.
  bool run(Reached from) {
    while (from.at->operation != Operation::End) {
      it_ = from.at;
      next_ = it_ + 1;
      top_ = static_cast<std::size_t>(from.top - stack_);
      if (!step()) return false;
      from = run_quickly(next_, entries_, stack_ + top_);
    }
    return true;
  }

 private:
  bool step() {
    switch (it_->operation) {
      case Operation::Text:
        return push(Operand::of(&program_.texts[it_->argument]));
      case Operation::Load:
      case Operation::LoadToCompare:
        return load();
      case Operation::LoadCopy:
        return load() && copy_text();
      case Operation::LoadShown:
        return load_shown();
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
        return combine();
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
        return no_entry();
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
                            operands_of(it_->operation), shown(operand)));
  }
  bool wrong_operands(std::string_view left, std::string_view right) {
    return fail(fmt::format("'{}' takes {}, not {} and {}", sign_of(it_->operation, it_->relation),
                            operands_of(it_->operation), left, right));
  }
  std::string shown(const Operand& operand, int nth = 0) const {
    return described(operand, expression_, entries_, it_, nth);
  }
  bool wrong_operands() {
    const bool are_empty = last().kind == Operand::Kind::Empty;
    return wrong_operands(shown(before_last(), are_empty ? 1 : 0), shown(last()));
  }
  bool no_entry() {
    return fail(
        fmt::format("there is no entry '{}'; '{} := …' makes it", brief(name()), brief(name())));
  }

  bool load() {
    const Entry& from = entry();
    if (!from.is_present) return no_entry();
    return push(Operand::of(from.value()));
  }

  bool load_shown() {
    std::string& text = text_at(top_);
    text = entry().has_value() ? to_text(entry().value()) : "{" + name() + "}";
    return push(Operand::of(&text));
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

  bool calculate() {
    const bool are_texts =
        before_last().kind == Operand::Kind::Text && last().kind == Operand::Kind::Text;
    return it_->operation == Operation::Add && are_texts ? join_here() : wrong_operands();
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

  bool combine() {
    bool left = false;
    bool right = false;
    if (!take_condition(before_last(), left) || !take_condition(last(), right)) {
      return wrong_operands();
    }
    const bool holds = it_->operation == Operation::And ? left && right : left || right;
    return replace_two(Operand::of(holds ? 1.0 : 0.0));
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
      holds = is_true(*it_, first, second);
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
    bool flag = false;
    const bool is_flag = it_->operation == Operation::Not && last().kind == Operand::Kind::Text &&
                         take_condition(last(), flag);
    if (is_flag) number = flag ? 1 : 0;
    if (!is_flag && !take(last(), number)) return wrong_operand(last());
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
      const auto found = number_in_script(*last().text, nullptr);
      is_number = found.has_value();
      number = found.value_or(0);
    }
    if (!is_number) return wrong_operand(last());
    --top_;
    return number != 0 || go_to(it_->argument);
  }

  // The value of an assignment is what the entry then has.
  bool store(const Operand& value) {
    if (!assign(entry(), value, expression_.enums())) {
      return fail(refusal(entry(), value, shown(value), name()));
    }
    last() = Operand::of(entry().value());
    return copy_text();
  }

  bool store_changed() {
    if (!entry().is_present) return no_entry();
    const Operand old = Operand::of(entry().value());
    double left = 0;
    double right = 0;
    if (take(old, left) && take(last(), right)) {
      return store(Operand::of(calculated(left, it_->operation, right)));
    }
    const bool are_texts = old.kind == Operand::Kind::Text && last().kind == Operand::Kind::Text;
    if (it_->operation != Operation::AddTo || !are_texts) {
      return wrong_operands(old.kind == Operand::Kind::Empty ? without_value(name()) : shown(old),
                            shown(last()));
    }
    std::string& joined = text_at(top_);
    joined = *old.text;
    joined += *last().text;
    return check_length(joined) && store(Operand::of(&joined));
  }

  const Expression& expression_;
  const ScriptProgram& program_;
  Entry* const* const entries_;
  Operand* const stack_;
  std::string* const texts_;
  std::size_t top_ = 0;
  const Instruction* it_ = nullptr;
  const Instruction* next_ = nullptr;
  std::string& error_;
};

// Out of line, so that what happens each time is short.
[[gnu::noinline]] bool run_slowly(Machine&& machine, const Reached& from) {
  return machine.run(from);
}

[[gnu::noinline]] std::string no_condition(std::string_view operand) {
  return fmt::format("a condition is {}, not {}", kCondition, operand);
}

}  // namespace

inline const Operand* Evaluator::run(const Expression& expression,
                                     std::span<Entry* const> entries) {
  const std::size_t size = expression.program().stack + std::size_t{1};
  if (stack_.size() < size) [[unlikely]] {
    stack_.resize(size);
    texts_.resize(size);
  }
  Operand* const stack = stack_.data();
  const Reached reached = run_quickly(expression.program().code.data(), entries.data(), stack);
  if (reached.at->operation == Operation::End) [[likely]]
    return stack;
  const bool ran = run_slowly(Machine(expression, entries, stack, texts_.data(), error_), reached);
  return ran ? stack : nullptr;
}

bool Evaluator::evaluate(const Expression& expression, std::span<Entry* const> entries,
                         Value& result) {
  const Operand* const last = run(expression, entries);
  if (last != nullptr) last->store(result);
  return last != nullptr;
}

bool Evaluator::execute(const Expression& expression, std::span<Entry* const> entries) {
  return run(expression, entries) != nullptr;
}

Truth Evaluator::test(const Expression& expression, std::span<Entry* const> entries) {
  const Operand* const last = run(expression, entries);
  if (last == nullptr) return Truth::Error;
  bool holds = false;
  if (take_condition(*last, holds)) return holds ? Truth::Yes : Truth::No;
  const auto& code = expression.program().code;
  error_ = no_condition(described(*last, expression, entries.data(), code.data() + code.size()));
  return Truth::Error;
}

}  // namespace lockstep::host
