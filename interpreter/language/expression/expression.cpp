#include "language/expression/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "language/expression/token.h"

namespace lockstep::host {
namespace {

constexpr unsigned kDeepest = 256;  // levels of brackets, signs, assignments and conditions

// How strongly an operator between two values binds, from 1, and what it does.
struct Binary {
  Symbol symbol = {};
  unsigned strength = 0;  // 0: it is none
  Operation operation = {};
  Relation relation = {};
};
constexpr unsigned kCompareStrength = 3;
constexpr Binary kBinaries[] = {
    {Symbol::Or, 1, Operation::Or},
    {Symbol::And, 2, Operation::And},
    {Symbol::Equal, kCompareStrength, Operation::Compare, Relation::Equal},
    {Symbol::NotEqual, kCompareStrength, Operation::Compare, Relation::NotEqual},
    {Symbol::Less, kCompareStrength, Operation::Compare, Relation::Less},
    {Symbol::LessEqual, kCompareStrength, Operation::Compare, Relation::LessEqual},
    {Symbol::Greater, kCompareStrength, Operation::Compare, Relation::Greater},
    {Symbol::GreaterEqual, kCompareStrength, Operation::Compare, Relation::GreaterEqual},
    {Symbol::BitOr, 4, Operation::BitOr},
    {Symbol::BitXor, 4, Operation::BitXor},
    {Symbol::BitAnd, 5, Operation::BitAnd},
    {Symbol::Plus, 6, Operation::Add},
    {Symbol::Minus, 6, Operation::Subtract},
    {Symbol::Join, 6, Operation::Join},
    {Symbol::Times, 7, Operation::Multiply},
    {Symbol::Divided, 7, Operation::Divide},
};

Binary binary(Symbol symbol) {
  const auto* const found = std::ranges::find(kBinaries, symbol, &Binary::symbol);
  return found == std::end(kBinaries) ? Binary{} : *found;
}

struct Assignment {
  Symbol symbol;
  Operation operation;
};
constexpr Assignment kAssignments[] = {
    {Symbol::Make, Operation::Store},
    {Symbol::Assign, Operation::Store},
    {Symbol::AddTo, Operation::AddTo},
    {Symbol::SubtractFrom, Operation::SubtractFrom},
    {Symbol::MultiplyBy, Operation::MultiplyBy},
    {Symbol::DivideBy, Operation::DivideBy},
};

std::optional<Operation> assignment(Symbol symbol) {
  const auto* const found = std::ranges::find(kAssignments, symbol, &Assignment::symbol);
  return found == std::end(kAssignments) ? std::nullopt : std::optional(found->operation);
}

std::string column(std::size_t offset) {
  return fmt::format("column {}", offset + 1);
}

}  // namespace

// By precedence, in one pass: an operand is compiled before the operator that follows it.
class ExpressionParser {
 public:
  ExpressionParser(std::string_view script, std::shared_ptr<const ScriptEnums> enums,
                   Expression::Words words)
      : script_(script), words_(words) {
    result_.enums_ = std::move(enums);
  }

  tl::expected<Expression, Expression::Error> parse() {
    if (!advance() || !statements()) return tl::unexpected(std::move(*error_));
    emit(Operation::End);
    number_readings();
    copy_loaded_texts();
    return std::move(result_);
  }

  // Its parts, joined.
  tl::expected<Expression, Expression::Error> parse_template() {
    if (script_.empty()) {
      fail("the text is empty", "write a text for people", 0);
      return tl::unexpected(std::move(*error_));
    }
    push_text("");  // all of it is a text, also a number
    for (std::size_t at = 0; at < script_.size();) {
      const std::size_t open = std::min(script_.find('{', at), script_.size());
      if (open > at) join([&] { push_text(script_.substr(at, open - at)); });
      if (open == script_.size()) break;
      const std::size_t close = script_.find('}', open);
      const std::string_view key = script_.substr(open + 1, close - open - 1);
      if (close == std::string_view::npos || !is_identifier(key)) {
        fail(close == std::string_view::npos ? std::string("'{' has no '}'")
                                             : fmt::format("'{}' is not a key", brief(key)),
             "{key} stands for the value of an entry", open);
        return tl::unexpected(std::move(*error_));
      }
      join([&] {
        const std::uint32_t entry = use(key);
        result_.uses_[entry].is_read = true;
        push(Instruction::of(Operation::LoadShown, entry));
      });
      at = close + 1;
    }
    emit(Operation::End);
    return std::move(result_);
  }

 private:
  template <class Push>
  void join(Push push) {
    push();
    emit(Operation::Join);
    --depth_;
  }

  // An operand as a left side: a name, and where its code begins.
  struct Operand {
    std::string_view name = {};
    std::size_t offset;
    std::size_t code;
  };

  bool fail(std::string message, std::string hint, std::size_t offset) {
    error_ = Expression::Error{std::move(message), std::move(hint), offset};
    return false;
  }

  bool advance() {
    auto token = reader_.next(script_, next_);
    if (!token) error_ = std::move(token.error());
    if (!token) return false;
    token_ = *token;
    const bool may_be_sign = token_.symbol == Symbol::Name && words_ == Expression::Words::AreSigns;
    if (may_be_sign && token_.text == "and") token_.symbol = Symbol::And;
    if (may_be_sign && token_.text == "or") token_.symbol = Symbol::Or;
    return true;
  }

  bool accept(Symbol symbol, bool& accepted) {
    accepted = token_.symbol == symbol;
    return !accepted || advance();
  }

  std::string shown() const {
    if (token_.symbol == Symbol::End) return "at the end";
    const std::string_view rest = script_.substr(token_.offset, next_ - token_.offset);
    return fmt::format("before '{}'", brief(rest));
  }

  bool statements() {
    if (token_.symbol == Symbol::End) {
      return fail("the script is empty", "write an expression: battery > 20", 0);
    }
    if (token_.symbol == Symbol::Semicolon) {
      return fail("a script does not begin with ';'", "remove it", token_.offset);
    }
    while (true) {
      if (!expression()) return false;
      while (token_.symbol == Symbol::Semicolon) {
        if (!advance()) return false;
      }
      if (token_.symbol == Symbol::End) return true;
      emit(Operation::Pop);
      --depth_;
    }
  }

  // Brackets and right sides nest; not deeper than the stack of this program allows. Returns the
  // name in `name` if it is no more than that.
  bool expression(std::string_view& name) {
    if (!enter()) return false;
    Operand left{.offset = token_.offset, .code = code().size()};
    const std::uint32_t depth = depth_;
    bool good = ternary(left);
    name = left.name;
    if (good && assignment(token_.symbol)) {
      name = {};
      good = assign(left, depth);
    }
    --level_;
    return good;
  }
  bool expression() {
    std::string_view name;
    return expression(name);
  }

  bool enter() {
    if (++level_ <= kDeepest) return true;
    return fail(fmt::format("the script is nested more than {} levels deep", kDeepest),
                "make several scripts of it", token_.offset);
  }

  bool assign(const Operand& left, std::uint32_t depth) {
    const Token sign = token_;
    const auto operation = *assignment(sign.symbol);
    code().resize(left.code);  // the name is not read
    result_.offsets_.resize(left.code);
    depth_ = depth;
    std::uint32_t entry = 0;
    if (left.name.empty()) {
      result_.remarks_.push_back({fmt::format("the left side of '{}' is not a name", sign.text),
                                  "only an entry can be assigned; '==' compares", left.offset});
      emit(Operation::NoTarget);
    } else {
      entry = use(left.name);
      auto& use = result_.uses_[entry];
      use.is_assigned = true;
      use.is_made = use.is_made || sign.symbol == Symbol::Make;
      use.is_read = use.is_read || operation != Operation::Store;
      emit(sign.symbol == Symbol::Make ? Operation::Make : Operation::Need, entry);
    }
    has_assignment_ = true;
    if (!advance() || !expression()) return false;
    emit_at(sign.offset, operation, entry);
    return true;
  }

  bool ternary(Operand& first) {
    if (!operand_with(1, first)) return false;
    if (token_.symbol != Symbol::Question) return true;
    const Token question = token_;
    first.name = {};
    const std::size_t to_else = emit(Operation::JumpIfZero);
    --depth_;
    if (!advance() || !expression()) return false;
    bool has_colon = false;
    const std::size_t before = token_.offset;
    if (!accept(Symbol::Colon, has_colon)) return false;
    if (!has_colon) {
      return fail(fmt::format("':' is missing {}", shown()),
                  fmt::format("the '?' in {} needs both values: condition ? value : other",
                              column(question.offset)),
                  before);
    }
    const std::size_t to_end = emit(Operation::Jump);
    --depth_;
    go_here(to_else);
    if (!enter()) return false;
    Operand other{.offset = token_.offset, .code = code().size()};
    if (!ternary(other)) return false;
    --level_;
    go_here(to_end);
    return true;
  }

  // An operand with all operators behind it that bind at least so strongly.
  bool operand_with(unsigned strength, Operand& left) {
    if (!unary(left)) return false;
    while (true) {
      const Binary it = binary(token_.symbol);
      if (it.strength < strength || it.strength == 0) return true;
      left.name = {};
      if (it.strength == kCompareStrength) {
        if (!comparisons()) return false;
        continue;
      }
      const std::size_t sign = token_.offset;
      if (!advance() || !right_of(it)) return false;
      emit_at(sign, it.operation);
      --depth_;
    }
  }

  bool right_of(const Binary& it) {
    Operand right{.offset = token_.offset, .code = code().size()};
    return operand_with(it.strength + 1, right);
  }

  // a < b < c: it ends at the first that does not hold.
  bool comparisons() {
    std::vector<std::size_t> ends;
    bool is_close = reads_progress();
    for (Binary it = binary(token_.symbol); it.strength == kCompareStrength;) {
      const std::size_t sign = token_.offset;
      if (!advance() || !right_of(it)) return false;
      const Binary next = binary(token_.symbol);
      const bool is_last = next.strength != kCompareStrength;
      const std::size_t at = emit_at(sign, is_last ? Operation::Compare : Operation::CompareNext);
      const bool is_next_close = reads_progress(at);
      code()[at].relation = it.relation;
      if (is_close || is_next_close) code()[at].whole = kOfProgress;
      is_close = is_next_close;
      if (is_last) compare_early(at);
      --depth_;
      if (!is_last) ends.push_back(at);
      it = next;
    }
    for (const std::size_t end : ends) go_here(end);
    return true;
  }

  // Whether the last operand is the progress of a node.
  bool reads_progress() { return reads_progress(code().size()); }
  bool reads_progress(std::size_t end) {
    if (end == 0) return false;
    const Instruction& last = code()[end - 1];
    return last.operation == Operation::Load && last.argument >= kFirstReading &&
           result_.readings_[last.argument - kFirstReading].what == Reading::What::Progress;
  }

  // The instruction that loads an entry, where what follows compares it with a number.
  void compare_early(std::size_t compare) {
    if (compare < 2) return;
    const Instruction& number = code()[compare - 1];
    Instruction& load = code()[compare - 2];
    const bool is_real = number.operation == Operation::Real;
    const bool is_exact = number.operation == Operation::Whole && number.whole <= kLargestExact;
    const bool is_entry = load.operation == Operation::Load && load.argument < kFirstReading;
    if (!is_entry || (!is_real && !is_exact)) return;
    load.operation = Operation::LoadToCompare;
    load.relation = code()[compare].relation;
    load.real = is_real ? number.real : static_cast<double>(number.whole);
  }

  bool unary(Operand& operand) {
    std::optional<Operation> sign;
    if (token_.symbol == Symbol::Minus) sign = Operation::Negate;
    if (token_.symbol == Symbol::Complement) sign = Operation::Complement;
    if (token_.symbol == Symbol::Not) sign = Operation::Not;
    if (!sign) return primary(operand);
    const std::size_t offset = token_.offset;
    if (!enter() || !advance() || !unary(operand)) return false;
    --level_;
    operand.name = {};
    emit_at(offset, *sign);
    return true;
  }

  bool primary(Operand& operand) {
    const Token token = token_;
    switch (token.symbol) {
      case Symbol::Whole:
        return advance() && push(Instruction::of(token.whole));
      case Symbol::Real:
        return advance() && push(Instruction::of(Operation::Real, token.real));
      case Symbol::Text:
      case Symbol::Word:
        return advance() && push_text(token.text);
      case Symbol::Name:
        return advance() && name(token, operand);
      case Symbol::Reading:
        return advance() && reading(token);
      case Symbol::Open:
        return advance() && brackets(token, operand);
      default:
        return missing_value();
    }
  }

  bool missing_value() {
    if (token_.symbol == Symbol::Close) {
      return fail(fmt::format("unexpected ')'"), "a value, or a '(' before it, is missing",
                  token_.offset);
    }
    return fail(fmt::format("a value is missing {}", shown()),
                "a value is a number, a text in quotes, true, false or the name of an entry",
                token_.offset);
  }

  bool brackets(const Token& open, Operand& operand) {
    if (!expression(operand.name)) return false;  // a name in brackets is a name
    bool is_closed = false;
    const std::string where = shown();
    const std::size_t offset = token_.offset;
    if (!accept(Symbol::Close, is_closed)) return false;
    if (is_closed) return true;
    return fail(fmt::format("')' is missing {}", where),
                fmt::format("the '(' in {} is not closed", column(open.offset)), offset);
  }

  bool name(const Token& token, Operand& operand) {
    operand.name = token.text;
    if (token.text == "true" || token.text == "false") {
      operand.name = {};
      return push(Instruction::of(Operation::Truth, token.text == "true" ? 1.0 : 0.0));
    }
    const ScriptEnums* const enums = result_.enums();
    if (enums != nullptr) {
      const auto word = enums->find(token.text);
      if (word != enums->end()) return push(Instruction::of(Operation::Real, word->second));
    }
    // This is taken back for a left side.
    const Symbol next = token_.symbol;
    const std::uint32_t entry = use(token.text);
    if (!assignment(next)) result_.uses_[entry].is_read = true;
    return push(Instruction::of(Operation::Load, entry));
  }

  bool reading(const Token& token) {
    auto& all = result_.readings_;
    const auto [same, is_new] = readings_.emplace(std::pair(token.reading, token.text),
                                                  static_cast<std::uint32_t>(all.size()));
    const std::uint32_t number = same->second;
    if (is_new) {
      const auto offset = static_cast<std::size_t>(token.text.data() - script_.data());
      all.push_back({token.reading, std::string(token.text), offset});
    }
    return push(Instruction::of(Operation::Load, kFirstReading + number));
  }

  // When all names are known.
  void number_readings() {
    const auto first = static_cast<std::uint32_t>(result_.names_.size());
    for (Instruction& it : code()) {
      const bool loads =
          it.operation == Operation::Load || it.operation == Operation::LoadToCompare;
      if (loads && it.argument >= kFirstReading) it.argument += first - kFirstReading;
    }
  }

  std::uint32_t use(std::string_view name) {
    const auto found = numbers_.find(name);
    if (found != numbers_.end()) return found->second;
    const auto number = static_cast<std::uint32_t>(result_.names_.size());
    result_.names_.emplace_back(name);
    result_.uses_.push_back({.offset = static_cast<std::size_t>(name.data() - script_.data())});
    numbers_.emplace(name, number);
    return number;
  }

  bool push_text(std::string_view text) {
    const auto number = static_cast<std::uint32_t>(program().texts.size());
    program().texts.emplace_back(text);
    return push(Instruction::of(Operation::Text, number));
  }
  bool push(const Instruction& operand) {
    add(token_.offset, operand);
    grow();
    return true;
  }

  void grow() { program().stack = std::max(program().stack, ++depth_); }

  std::size_t emit(Operation operation, std::uint32_t argument = 0) {
    return emit_at(token_.offset, operation, argument);
  }
  std::size_t emit_at(std::size_t offset, Operation operation, std::uint32_t argument = 0) {
    return add(offset, Instruction::of(operation, argument));
  }
  std::size_t add(std::size_t offset, const Instruction& instruction) {
    code().push_back(instruction);
    result_.offsets_.push_back(static_cast<std::uint32_t>(offset));
    return code().size() - 1;
  }
  void go_here(std::size_t from) {
    code()[from].argument = static_cast<std::uint32_t>(code().size());
  }

  void copy_loaded_texts() {
    if (!has_assignment_) return;
    for (Instruction& it : code()) {
      if (it.operation == Operation::Load) it.operation = Operation::LoadCopy;
    }
  }

  static constexpr std::uint32_t kFirstReading = 0x80000000;  // until all names are known

  ScriptProgram& program() { return result_.program_; }
  std::vector<Instruction>& code() { return result_.program_.code; }

  std::string_view script_;
  Expression::Words words_;
  TokenReader reader_;
  std::size_t next_ = 0;  // behind token_
  Token token_{.symbol = Symbol::End, .text = {}};
  Expression result_;
  std::optional<Expression::Error> error_;
  std::map<std::string_view, std::uint32_t> numbers_;  // of the names
  std::map<std::pair<Reading::What, std::string_view>, std::uint32_t> readings_;
  std::uint32_t depth_ = 0;  // operands on the stack
  unsigned level_ = 0;
  bool has_assignment_ = false;
};

tl::expected<Expression, Expression::Error> Expression::parse(
    std::string_view text, std::shared_ptr<const ScriptEnums> enums, Words words) {
  auto parsed = ExpressionParser(text, std::move(enums), words).parse();
  if (parsed) parsed->text_ = text;
  return parsed;
}

tl::expected<Expression, Expression::Error> Expression::parse_template(std::string_view text) {
  auto parsed = ExpressionParser(text, nullptr, Words::AreNames).parse_template();
  if (parsed) parsed->text_ = text;
  return parsed;
}

}  // namespace lockstep::host
