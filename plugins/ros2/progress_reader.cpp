// Reads the text of a progress expression: sums of products of terms.
#include <cctype>
#include <cstdlib>
#include <optional>

#include "package_index.hpp"
#include "progress.hpp"

namespace ros2 {

class ProgressReader {
 public:
  ProgressReader(const std::string& text, const std::vector<Field>& goal,
                 const std::vector<Field>& feedback)
      : text_(text), goal_(goal), feedback_(feedback) {}

  Result<Progress> read() {
    sum();
    if (!problem_ && at_ != text_.size()) unexpected("an operator or the end");
    if (problem_) return *problem_;
    return std::move(progress_);
  }

 private:
  using Step = Progress::Step;
  using What = Step::What;
  static constexpr int kDeepest = 30;  // so that no stack of Progress::value is too small

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
      sum();
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
    if (name == "elapsed") return add({What::Elapsed});
    if (name == "first") {
      expect('(');
      sum();
      expect(')');
      return add({What::First, 0, progress_.firsts_++});
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
    const bool is_of_goal = name.rfind("goal.", 0) == 0;
    const bool is_of_feedback = name.rfind("feedback.", 0) == 0;
    if (!is_of_goal && !is_of_feedback) {
      return fail("knows no '" + name + "'",
                  "use goal.FIELD, feedback.FIELD, elapsed, first(…), size(…), min(…, …) and "
                  "max(…, …)");
    }
    const auto& fields = is_of_goal ? goal_ : feedback_;
    const std::string prefix = is_of_goal ? "goal." : "feedback.";
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
    add({what, 0, static_cast<std::size_t>(found - fields.data()), is_of_goal});
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
    if (!problem_) problem_ = Problem{"the progress '" + text_ + "' " + what, hint};
  }

  void add(const Step& step) {
    if (!problem_) progress_.steps_.push_back(step);
  }

  const std::string& text_;
  const std::vector<Field>& goal_;
  const std::vector<Field>& feedback_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Progress progress_;
  std::optional<Problem> problem_;
};

Result<Progress> read_progress(const std::string& text, const std::vector<Field>& goal,
                               const std::vector<Field>& feedback) {
  return ProgressReader(text, goal, feedback).read();
}

}  // namespace ros2
