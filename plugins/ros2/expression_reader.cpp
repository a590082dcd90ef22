// Reads the text of an expression: from what is joined by `or` down to terms.
#include <cctype>
#include <cstdlib>
#include <optional>

#include "expression.hpp"
#include "package_index.hpp"

namespace ros2 {

// What the texts of an expression are about.
struct Subject {
  struct Part {
    std::string prefix;
    const std::vector<Field>& fields;
  };
  const char* what;  // "progress"
  std::vector<Part> parts;
  const char* given = "elapsed";  // the number that no message has
};

class ExpressionReader {
 public:
  ExpressionReader(const std::string& text, const Subject& subject)
      : text_(text), subject_(subject) {}

  Result<Expression> read() {
    either();
    if (!problem_ && at_ != text_.size()) unexpected("an operator or the end");
    if (problem_) return *problem_;
    return std::move(expression_);
  }

 private:
  using Step = Expression::Step;
  using What = Step::What;
  static constexpr int kDeepest = 30;  // so that no stack of Expression::value is too small

  void either() {
    both();
    while (takes("or")) {
      both();
      add({What::Or});
    }
  }

  void both() {
    negated();
    while (takes("and")) {
      negated();
      add({What::And});
    }
  }

  void negated() {
    bool is_negated = false;
    while (takes("not")) is_negated = !is_negated;
    comparison();
    if (is_negated) add({What::Not});
  }

  void comparison() {
    sum();
    const std::string sign = comparing_sign();
    if (sign.empty()) return;
    sum();
    if (sign == "==" || sign == "!=") add({What::Equal});
    // a > b is what is not true of a <= b, also when both are numbers only.
    if (sign == "<" || sign == ">=") add({What::Less});
    if (sign == "<=" || sign == ">") add({What::LessOrEqual});
    if (sign == "!=" || sign == ">=" || sign == ">") add({What::Not});
  }

  // "" when there is none.
  std::string comparing_sign() {
    const char first = next();
    if (problem_ || std::string("<>=!").find(first) == std::string::npos || first == '\0')
      return {};
    std::string sign(1, first);
    if (at_ + 1 < text_.size() && text_[at_ + 1] == '=') sign += '=';
    if (sign == "=" || sign == "!") {
      unexpected("one of < <= > >= == !=");
      return {};
    }
    at_ += sign.size();
    return sign;
  }

  // Whether the next word is this one, which is read then.
  bool takes(const char* expected) {
    if (problem_) return false;
    const std::size_t before = at_;
    if (word() == expected) return true;
    at_ = before;
    return false;
  }

  void sum() {
    product();
    for (char sign = next(); !problem_ && (sign == '+' || sign == '-'); sign = next()) {
      ++at_;
      product();
      add({sign == '+' ? What::Add : What::Subtract});
    }
  }

  void product() {
    term();
    for (char sign = next(); !problem_ && (sign == '*' || sign == '/'); sign = next()) {
      ++at_;
      term();
      add({sign == '*' ? What::Multiply : What::Divide});
    }
  }

  void term() {
    if (problem_) return;
    if (++depth_ > kDeepest) return fail("is nested too deeply", "write it shorter");
    const char first = next();
    if (first == '-') {
      ++at_;
      term();
      add({What::Negate});
    } else if (first == '(') {
      ++at_;
      either();
      expect(')');
    } else if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.') {
      number();
    } else {
      named(word());
    }
    --depth_;
  }

  void number() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    const auto length = static_cast<std::size_t>(end - text_.c_str()) - at_;
    if (length == 0) return unexpected("a number");
    at_ += length;
    add({What::Number, value});
  }

  void named(const std::string& name) {
    if (name.empty()) return unexpected("a number, a field or a function");
    if (name == subject_.given) return add({What::Given});
    if (name == "first") {
      expect('(');
      sum();
      expect(')');
      return add({What::First, 0, expression_.firsts_++});
    }
    if (name == "min" || name == "max") {
      expect('(');
      sum();
      expect(',');
      sum();
      expect(')');
      return add({name == "min" ? What::Least : What::Most});
    }
    if (name == "size") {
      expect('(');
      const std::string of = word();
      expect(')');
      return field(of, What::Size);
    }
    field(name, What::Field);
  }

  void field(const std::string& name, What what) {
    if (problem_) return;
    std::size_t part = 0;
    const auto begins = [&](const Subject::Part& it) { return name.rfind(it.prefix, 0) == 0; };
    while (part < subject_.parts.size() && !begins(subject_.parts[part])) ++part;
    if (part == subject_.parts.size()) {
      std::string known;
      for (const auto& it : subject_.parts) known += it.prefix + "FIELD, ";
      return fail("knows no '" + name + "'",
                  "use " + known + subject_.given +
                      (known.empty() ? ", min(…, …) and max(…, …)"
                                     : ", first(…), size(…), min(…, …) and max(…, …)"));
    }
    const auto& [prefix, fields] = subject_.parts[part];
    const Field* const found = find_field(fields, name.substr(prefix.size()));
    if (found == nullptr) {
      std::vector<std::string> names;
      for (const Field& it : fields) names.push_back(prefix + it.path);
      return fail("knows no '" + name + "'", suggestion(name, names));
    }
    using Kind = Field::Kind;
    const bool is_number = found->kind == Kind::Bool || found->kind == Kind::Int ||
                           found->kind == Kind::Double || found->kind == Kind::Duration;
    const bool has_size = found->kind == Kind::String || found->rows != nullptr ||
                          (found->member != nullptr && found->member->is_array_);
    if (what == What::Size && !has_size) return fail("'" + name + "' has no size", "size(LIST)");
    if (what == What::Field && !is_number) {
      return fail("'" + name + "' is no number",
                  has_size ? "size(" + name + ") is one" : "name one of its fields");
    }
    add({what, 0, static_cast<std::size_t>(found - fields.data()), part == 1});
  }

  std::string word() {
    next();
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const auto c = static_cast<unsigned char>(text_[at_]);
      if (std::isalnum(c) == 0 && c != '_' && c != '.') break;
      ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  // The next character that is no blank; 0 at the end.
  char next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  void expect(char c) {
    if (problem_) return;
    if (next() != c) return unexpected(std::string("'") + c + "'");
    ++at_;
  }

  void unexpected(const std::string& expected) {
    const bool is_end = next() == '\0';
    fail(is_end ? "ends too early"
                : "has '" + text_.substr(at_, 1) + "' at " + std::to_string(at_ + 1),
         "expected " + expected);
  }

  void fail(const std::string& what, const std::string& hint) {
    if (!problem_)
      problem_ = Problem{std::string("the ") + subject_.what + " '" + text_ + "' " + what, hint};
  }

  void add(const Step& step) {
    if (!problem_) expression_.steps_.push_back(step);
  }

  const std::string& text_;
  const Subject& subject_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Expression expression_;
  std::optional<Problem> problem_;
};

Result<Expression> read_progress(const std::string& text, const std::vector<Field>& goal,
                                 const std::vector<Field>& feedback) {
  return ExpressionReader(text, {"progress", {{"goal.", goal}, {"feedback.", feedback}}}).read();
}

Result<Expression> read_condition(const std::string& text, const std::string& prefix,
                                  const std::vector<Field>& fields) {
  return ExpressionReader(text, {"condition", {{prefix, fields}}}).read();
}

Result<Expression> read_factor(const std::string& text) {
  return ExpressionReader(text, {"value", {}, "factor"}).read();
}

}  // namespace ros2
