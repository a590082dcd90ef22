#include "support/script_reference.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "language/expression/evaluator.h"

namespace lockstep::host::test {
namespace {

struct NoScript {};  // thrown where the text is not a script
struct Failed {};    // where it fails while it runs

struct Term {
  std::string what;  // "number", "text", "name", or an operator
  std::string text = {};
  Value value = {};
  std::vector<Term> parts = {};
};

bool is_one_of(char c, const std::string& set) {
  return set.find(c) != std::string::npos;
}
bool is_digit_of(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter_of(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// Cuts a script into words: "number", "text" and "name" have a value or a text.
std::vector<Term> words_of(const std::string& script) {
  std::vector<Term> words;
  std::size_t at = 0;
  const auto peek = [&](std::size_t ahead) {
    return at + ahead < script.size() ? script[at + ahead] : '\0';
  };
  while (at < script.size()) {
    const char c = script[at];
    if (is_one_of(c, " \t\r\n")) {
      ++at;
    } else if (c == '\'' || c == '"') {
      const auto end = script.find(c, at + 1);
      if (end == std::string::npos) throw NoScript();
      words.push_back({.what = "text", .value = script.substr(at + 1, end - at - 1)});
      at = end + 1;
    } else if (is_letter_of(c) || c == '@') {
      std::size_t end = at + 1;
      while (end < script.size() && (is_letter_of(script[end]) || is_digit_of(script[end]))) ++end;
      words.push_back({.what = "name", .text = script.substr(at, end - at)});
      at = end;
    } else if (is_digit_of(c)) {
      const bool is_hex = c == '0' && (peek(1) == 'x' || peek(1) == 'X');
      std::size_t end = at + (is_hex ? 2 : 0);
      bool is_real = false;
      const std::string digits = is_hex ? "0123456789abcdefABCDEF" : "0123456789";
      const std::size_t first = end;
      const auto skip_digits = [&] {
        const std::size_t from = end;
        while (end < script.size() && is_one_of(script[end], digits)) ++end;
        return end > from;
      };
      if (!skip_digits()) throw NoScript();
      if (!is_hex && script.compare(end, 1, ".") == 0 && script.compare(end, 2, "..") != 0) {
        ++end;
        is_real = true;
        if (!skip_digits()) throw NoScript();
      }
      if (!is_hex && end < script.size() && is_one_of(script[end], "eE")) {
        ++end;
        if (end < script.size() && is_one_of(script[end], "+-")) ++end;
        is_real = true;
        if (!skip_digits()) throw NoScript();
      }
      if (end < script.size() && (is_letter_of(script[end]) || is_digit_of(script[end]))) {
        throw NoScript();
      }
      const std::string text = script.substr(first, end - first);
      if (is_real) {
        const double real = std::strtod(text.c_str(), nullptr);
        if (std::isinf(real)) throw NoScript();
        words.push_back({.what = "number", .value = real});
      } else {
        std::int64_t whole = 0;
        const auto [rest, error] =
            std::from_chars(text.data(), text.data() + text.size(), whole, is_hex ? 16 : 10);
        if (error != std::errc()) throw NoScript();
        words.push_back({.what = "number", .value = whole});
      }
      at = end;
    } else {
      const std::string two = script.substr(at, 2);
      bool is_two = false;
      for (const char* it :
           {"&&", "||", "==", "!=", "<=", ">=", ":=", "+=", "-=", "*=", "/=", ".."}) {
        is_two = is_two || two == it;
      }
      if (!is_two && !is_one_of(c, "+-*/&|^~!<>=?:();")) throw NoScript();
      words.push_back({.what = script.substr(at, is_two ? 2 : 1)});
      at += is_two ? 2 : 1;
    }
  }
  return words;
}

using Level = std::vector<std::string>;
// From the weakest; the third is that of comparisons.
const std::vector<Level> kLevels = {{"||"},     {"&&"}, {"==", "!=", "<", "<=", ">", ">="},
                                    {"|", "^"}, {"&"},  {"+", "-", ".."},
                                    {"*", "/"}};

// One function for each line of the grammar.
class Grammar {
 public:
  explicit Grammar(std::vector<Term> words) : words_(std::move(words)) {}

  std::vector<Term> script() {
    std::vector<Term> statements{assign()};
    while (true) {
      while (accept(";")) {
      }
      if (at_ == words_.size()) return statements;
      statements.push_back(assign());
    }
  }

 private:
  bool is(const std::string& what) const { return at_ < words_.size() && words_[at_].what == what; }
  bool accept(const std::string& what) {
    if (!is(what)) return false;
    ++at_;
    return true;
  }

  Term assign() {
    Term left = ternary();
    for (const char* sign : {":=", "=", "+=", "-=", "*=", "/="}) {
      if (accept(sign)) return {.what = sign, .parts = {std::move(left), assign()}};
    }
    return left;
  }

  Term ternary() {
    Term condition = level(0);
    if (!accept("?")) return condition;
    Term first = assign();
    if (!accept(":")) throw NoScript();
    Term second = ternary();
    return {.what = "?", .parts = {std::move(condition), std::move(first), std::move(second)}};
  }

  Term level(std::size_t number) {
    if (number == kLevels.size()) return unary();
    Term left = level(number + 1);
    if (number == 2) return chain(std::move(left));
    while (const auto sign = accept_one(kLevels[number])) {
      left = {.what = *sign, .parts = {std::move(left), level(number + 1)}};
    }
    return left;
  }

  // Operands, and between them the signs in `text`, separated by blanks.
  Term chain(Term first) {
    Term all{.what = "chain", .parts = {std::move(first)}};
    while (const auto sign = accept_one(kLevels[2])) {
      all.text += *sign + " ";
      all.parts.push_back(level(3));
    }
    return all.parts.size() == 1 ? std::move(all.parts[0]) : all;
  }

  std::optional<std::string> accept_one(const Level& signs) {
    for (const std::string& sign : signs) {
      if (accept(sign)) return sign;
    }
    return std::nullopt;
  }

  Term unary() {
    for (const char* sign : {"-", "~", "!"}) {
      if (accept(sign)) return {.what = std::string("unary") + sign, .parts = {unary()}};
    }
    if (accept("(")) {
      Term inner = assign();
      if (!accept(")")) throw NoScript();
      return inner;
    }
    if (!is("number") && !is("text") && !is("name")) throw NoScript();
    return words_[at_++];
  }

  std::vector<Term> words_;
  std::size_t at_ = 0;
};

bool is_text(const Value& value) {
  return std::holds_alternative<std::string>(value);
}
std::optional<std::int64_t> held_whole(const Value& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  return std::nullopt;
}
bool is_number(const Value& value) {
  return held_whole(value) || std::holds_alternative<double>(value);
}

double real_of(const Value& value) {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  const auto whole = held_whole(value);
  if (!whole || std::llabs(*whole) > (1LL << 53) - 1) throw Failed();
  return static_cast<double>(*whole);
}

std::int64_t whole_of(const Value& value) {
  if (const auto whole = held_whole(value)) return *whole;
  const auto* real = std::get_if<double>(&value);
  if (real == nullptr || std::floor(*real) != *real) throw Failed();
  if (*real < -9223372036854775808.0 || *real >= 9223372036854775808.0) throw Failed();
  return static_cast<std::int64_t>(*real);
}

std::int64_t bits_of(const Value& value) {
  return whole_of(real_of(value));
}

// The texts that say yes or no.
const std::map<std::string, bool> kFlags = {{"true", true},   {"True", true},   {"TRUE", true},
                                            {"1", true},      {"false", false}, {"False", false},
                                            {"FALSE", false}, {"0", false}};

bool condition_of(const Value& value) {
  if (is_text(value)) {
    const auto flag = kFlags.find(std::get<std::string>(value));
    if (flag == kFlags.end()) throw Failed();
    return flag->second;
  }
  if (const auto whole = held_whole(value)) {
    if (*whole != 0 && *whole != 1) throw Failed();
    return *whole == 1;
  }
  const auto* real = std::get_if<double>(&value);
  if (real == nullptr || *real < 0) throw Failed();
  return *real != 0;
}

double front_of(const std::string& text) {
  double real = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), real).ec != std::errc()) {
    throw Failed();
  }
  return real;
}

std::string plain(const Value& value) {
  if (is_text(value)) return std::get<std::string>(value);
  char text[400];
  if (const auto whole = held_whole(value)) {
    std::snprintf(text, sizeof text, "%lld", static_cast<long long>(*whole));
  } else {
    std::snprintf(text, sizeof text, "%f", std::get<double>(value));
  }
  return text;
}

using ReferenceEntries = std::map<std::string, Entry>;

class Walk {
 public:
  Walk(ReferenceEntries& entries, const ScriptEnums& enums) : entries_(entries), enums_(enums) {}

  Value value_of(const Term& term) {
    if (term.what == "number" || term.what == "text") return term.value;
    if (term.what == "name") return named(term.text);
    if (term.what == "?") return value_of(term.parts[asks(term.parts[0]) ? 1 : 2]);
    if (term.what == "chain") return chain(term);
    if (term.what.starts_with("unary")) return one(term.what.back(), value_of(term.parts[0]));
    if (term.what.ends_with("=")) return assigned(term);
    const Value left = value_of(term.parts[0]);
    return two(term.what, left, value_of(term.parts[1]));
  }

 private:
  Entry& existing(const std::string& name) {
    const auto found = entries_.find(name);
    if (found == entries_.end() || !found->second.is_present) throw Failed();
    return found->second;
  }

  Value named(const std::string& name) {
    if (name == "true") return 1.0;
    if (name == "false") return 0.0;
    const auto word = enums_.find(name);
    return word != enums_.end() ? Value(word->second) : loaded(existing(name).value());
  }

  // In a script, true and false are whole numbers.
  static Value loaded(const Value& value) {
    const auto whole = held_whole(value);
    return whole ? Value(*whole) : value;
  }

  bool asks(const Term& term) {
    const Value value = value_of(term);
    if (!is_text(value)) return real_of(value) != 0;
    const auto& text = std::get<std::string>(value);
    return kFlags.contains(text) ? kFlags.at(text) : front_of(text) != 0;
  }

  // Of a text: the number that it means.
  double meant(const Value& value) {
    if (!is_text(value)) return real_of(value);
    const auto& text = std::get<std::string>(value);
    if (text == "true" || text == "false") return text == "true" ? 1 : 0;
    const auto word = enums_.find(text);
    if (word != enums_.end()) return word->second;
    return kFlags.contains(text) ? kFlags.at(text) : front_of(text);
  }

  template <class T>
  static bool compared(const T& left, const std::string& sign, const T& right, bool is_equal) {
    if (sign == "==") return is_equal;
    if (sign == "!=") return !is_equal;
    if (sign == "<=") return left < right || is_equal;
    if (sign == ">=") return left > right || is_equal;
    return sign == "<" ? !compared(left, ">=", right, is_equal)
                       : !compared(left, "<=", right, is_equal);
  }

  bool are_related(const Value& left, const std::string& sign, const Value& right) {
    if (is_text(left) && is_text(right)) {
      const auto& a = std::get<std::string>(left);
      const auto& b = std::get<std::string>(right);
      return compared(a, sign, b, a == b);
    }
    const double a = meant(left);
    const double b = meant(right);
    const bool is_equal = std::fabs(a - b) <= std::numeric_limits<float>::epsilon();
    return compared(a, sign, b, is_equal);
  }

  Value chain(const Term& term) {
    std::string signs = term.text;
    Value left = value_of(term.parts[0]);
    for (std::size_t i = 1; i < term.parts.size(); ++i) {
      const auto end = signs.find(' ');
      const Value right = value_of(term.parts[i]);
      if (!are_related(left, signs.substr(0, end), right)) return 0.0;
      signs = signs.substr(end + 1);
      left = right;
    }
    return 1.0;
  }

  static Value one(char sign, const Value& value) {
    if (sign == '!' && is_text(value)) return condition_of(value) ? 0.0 : 1.0;
    const double real = real_of(value);
    if (sign == '-') return -real;
    if (sign == '!') return real != 0 ? 0.0 : 1.0;
    return static_cast<double>(~whole_of(std::trunc(real)));
  }

  static Value two(const std::string& sign, const Value& left, const Value& right) {
    if (sign == "&&" || sign == "||") {
      const bool a = condition_of(left);
      const bool b = condition_of(right);
      return (sign == "&&" ? a && b : a || b) ? 1.0 : 0.0;
    }
    if (sign == "&") return static_cast<double>(bits_of(left) & bits_of(right));
    if (sign == "|") return static_cast<double>(bits_of(left) | bits_of(right));
    if (sign == "^") return static_cast<double>(bits_of(left) ^ bits_of(right));
    if (sign == ".." || (sign == "+" && is_text(left) && is_text(right))) {
      if (!is_text(left) && !is_text(right)) throw Failed();
      for (const Value& it : {left, right}) {
        if (!is_text(it) && !is_number(it)) throw Failed();
      }
      return plain(left) + plain(right);
    }
    const double a = real_of(left);
    const double b = real_of(right);
    return sign == "+" ? a + b : sign == "-" ? a - b : sign == "*" ? a * b : a / b;
  }

  Value assigned(const Term& term) {
    if (term.parts[0].what != "name" || term.parts[0].text == "true" ||
        term.parts[0].text == "false") {
      throw Failed();
    }
    const std::string& name = term.parts[0].text;
    if (term.what == ":=") {
      const auto [found, is_new] = entries_.try_emplace(name);
      if (is_new || !found->second.is_present) make_entry(found->second, Typing::Any);
    }
    existing(name);
    Value right = value_of(term.parts[1]);
    Entry& entry = existing(name);
    if (term.what.size() == 2 && term.what[0] != ':') {
      right = two(term.what.substr(0, 1), entry.value(), right);
    }
    store(entry, right);
    return loaded(entry.value());
  }

  void store(Entry& entry, const Value& value) {
    if (std::holds_alternative<NoValue>(value)) throw Failed();
    const bool is_any = entry.typing == Typing::Any;
    const bool is_empty = std::holds_alternative<NoValue>(entry.value());
    if (is_empty && (is_any || !is_text(value))) {
      entry.assign(value);
    } else if (is_text(value) && !is_text(entry.value())) {
      entry.assign(is_any ? Value(meant(value)) : typed(entry.type, std::get<std::string>(value)));
    } else if (is_text(entry.value())) {
      if (!is_text(value)) throw Failed();
      entry.assign(value);
    } else if (std::holds_alternative<double>(entry.value())) {
      entry.assign(real_of(value));
    } else {
      entry.assign(whole_kind(entry, value));
    }
  }

  // For an entry that has a whole number.
  static Value whole_kind(const Entry& entry, const Value& value) {
    const auto* real = std::get_if<double>(&value);
    const bool is_fraction =
        real != nullptr && (std::trunc(*real) != *real || *real < -9223372036854775808.0 ||
                            *real >= 9223372036854775808.0);
    if (is_fraction) throw Failed();
    const std::int64_t whole = whole_of(value);
    const bool is_flag = std::holds_alternative<bool>(entry.value()) && (whole == 0 || whole == 1);
    return is_flag ? Value(whole == 1) : Value(whole);
  }

  static Value typed(ValueType type, const std::string& text) {
    if (type == ValueType::String) return text;
    if (type == ValueType::Double) return front_of(text);
    if (type == ValueType::Int) {
      std::int64_t whole = 0;
      if (std::from_chars(text.data(), text.data() + text.size(), whole).ec != std::errc()) {
        throw Failed();
      }
      return whole;
    }
    for (const char* word : {"1", "true", "True", "TRUE"}) {
      if (text == word) return true;
    }
    for (const char* word : {"0", "false", "False", "FALSE"}) {
      if (text == word) return false;
    }
    throw Failed();
  }

  ReferenceEntries& entries_;
  const ScriptEnums& enums_;
};

struct ReferenceRun {
  bool is_script = false;
  bool failed = false;  // while it ran
  Value value = {};     // of the last statement
};

ReferenceRun run_reference(const std::string& script, ReferenceEntries& entries,
                           const ScriptEnums& enums) {
  ReferenceRun run;
  try {
    const auto statements = Grammar(words_of(script)).script();
    run.is_script = true;
    Walk walk(entries, enums);
    for (const Term& it : statements) run.value = walk.value_of(it);
  } catch (const NoScript&) {
  } catch (const Failed&) {
    run.failed = true;
  }
  return run;
}

// The same kind and the same value; NaN is NaN.
bool is_same(const Value& left, const Value& right) {
  const auto* a = std::get_if<double>(&left);
  const auto* b = std::get_if<double>(&right);
  if (a != nullptr && b != nullptr && std::isnan(*a) && std::isnan(*b)) return true;
  return left == right;
}

bool is_same(const Entry& left, const Entry& right) {
  if (left.is_present != right.is_present) return false;
  if (!left.is_present) return true;
  return is_same(left.value(), right.value()) && left.writes() == right.writes() &&
         left.typing == right.typing && left.type == right.type;
}

ReferenceEntries entries_to_begin_with() {
  const auto entry = [](Typing typing, ValueType type, Value value) {
    Entry it;
    make_entry(it, typing, type);
    it.assign(std::move(value));
    it.count_from(0);
    return it;
  };
  constexpr auto kAny = Typing::Any;
  constexpr auto kDeclared = Typing::Declared;
  return {{"n", entry(kAny, ValueType::String, std::int64_t{3})},
          {"r", entry(kAny, ValueType::String, 2.5)},
          {"t", entry(kAny, ValueType::String, std::string("7b"))},
          {"e", entry(kAny, ValueType::String, {})},
          {"@n", entry(kDeclared, ValueType::Int, std::int64_t{1})},
          {"di", entry(kDeclared, ValueType::Int, {})},
          {"dd", entry(kDeclared, ValueType::Double, {})},
          {"db", entry(kDeclared, ValueType::Bool, true)},
          {"dt", entry(kDeclared, ValueType::String, {})}};
}

}  // namespace

std::string disagreement(const std::string& script) {
  static const auto kEnums = std::make_shared<const ScriptEnums>(ScriptEnums{{"RED", 2}});
  ReferenceEntries expected = entries_to_begin_with();
  ReferenceEntries entries = expected;
  const auto compiled = Expression::parse(script, kEnums);
  if (!compiled && compiled.error().message.find("levels deep") != std::string::npos) return {};
  const ReferenceRun reference = run_reference(script, expected, *kEnums);
  if (reference.is_script != compiled.has_value()) {
    return reference.is_script ? "it is a script: " + compiled.error().message : "it is no script";
  }
  if (!compiled) return {};
  Entry absent;
  unset_entry(absent);
  std::vector<Entry*> bound;
  for (const std::string& name : compiled->names()) {
    bound.push_back(&entries.try_emplace(name, absent).first->second);
  }
  Evaluator evaluator;
  Value value;
  const bool ran = evaluator.evaluate(*compiled, bound, value);
  if (ran == reference.failed) return "one of them failed: " + evaluator.error();
  if (ran && !is_same(value, reference.value)) {
    return "'" + to_text(value) + "', not '" + to_text(reference.value) + "'";
  }
  for (const auto& [name, entry] : entries) {
    if (!is_same(entry, expected.try_emplace(name, absent).first->second)) {
      return "entry '" + name + "' has '" + to_text(entry.value()) + "', not '" +
             to_text(expected.at(name).value()) + "'";
    }
  }
  return {};
}

}  // namespace lockstep::host::test
