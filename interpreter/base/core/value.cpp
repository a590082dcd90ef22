#include "base/core/value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

namespace lockstep::host {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool is_blank(char c) {
  return kBlanks.find(c) != std::string_view::npos;
}

std::string_view trim(std::string_view text) {
  if (!text.empty() && text.front() > ' ' && text.back() > ' ') return text;
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

template <class Number>
std::optional<Number> parse_digits(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// One overload for each alternative of Value. `out` is empty; false: the text is not a value.

bool parse(std::string_view text, bool& out) {
  const auto flag = parse_flag(trim(text));
  out = flag.value_or(false);
  return flag.has_value();
}

bool parse(std::string_view text, Flag& out) {
  return parse(text, out.is_set);
}

bool parse(std::string_view text, std::int64_t& out) {
  const auto number = parse_int(text);
  out = number.value_or(0);
  return number.has_value();
}

bool parse(std::string_view text, double& out) {
  const auto number = parse_double(text);
  out = number.value_or(0);
  return number.has_value();
}

bool parse(std::string_view text, std::string& out) {
  out = text;
  return true;
}

bool parse(std::string_view /*text*/, Object& /*out*/) {
  return false;
}

template <class T>
bool parse(std::string_view text, std::vector<T>& out) {
  constexpr std::string_view kSeparators = ";, \t\r\n";
  while (true) {
    const auto first = text.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) return true;
    text.remove_prefix(first);
    const auto length = std::min(text.find_first_of(kSeparators), text.size());
    if (!parse(text.substr(0, length), out.emplace_back())) return false;
    text.remove_prefix(length);
  }
}

// Removes the first string of a list with its separator. Blanks around it are not in it, unless
// they come after a backslash.
std::string take_string(std::string_view& text) {
  std::string item;
  std::size_t kept = 0;  // behind it are only blanks
  while (!text.empty()) {
    const char c = text.front();
    text.remove_prefix(1);
    if (c == ';') break;
    const bool is_escaped = c == '\\' && !text.empty();
    if (is_blank(c) && item.empty()) continue;
    item += is_escaped ? text.front() : c;
    if (is_escaped) text.remove_prefix(1);
    if (is_escaped || !is_blank(c)) kept = item.size();
  }
  item.resize(kept);
  return item;
}

// A separator at the end ends the last string, so the empty text is the list without any.
bool parse(std::string_view text, std::vector<std::string>& out) {
  while (!trim(text).empty()) out.push_back(take_string(text));
  return true;
}

template <class T>
std::optional<Value> parse_as(std::string_view text) {
  T value{};
  if (!parse(text, value)) return std::nullopt;
  return Value(std::move(value));
}

std::optional<Value> parse_number(std::string_view text) {
  auto whole = parse_as<std::int64_t>(text);
  return whole ? whole : parse_as<double>(text);
}

// Appends the text that parse() reads.
class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}

  void operator()(const NoValue&) const {}
  void operator()(bool flag) const { out_ += flag ? "true" : "false"; }
  void operator()(Flag flag) const { (*this)(flag.is_set); }
  void operator()(std::int64_t number) const { put(number); }
  void operator()(double number) const {
    // As fmt does, which would allocate.
    const double size = std::abs(number);
    const bool is_fixed = size == 0 || (size >= 1e-4 && size < 1e16);
    put(number, is_fixed ? std::chars_format::fixed : std::chars_format::scientific);
  }
  void operator()(const std::string& text) const { out_ += text; }
  void operator()(const Object& object) const {
    if (object.get() != nullptr) object.type()->append_text(object.get(), out_);
  }
  template <class T>
  void operator()(const std::vector<T>& list) const {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i > 0) out_ += ';';
      put_item(list[i]);
    }
    if constexpr (std::is_same_v<T, std::string>) {
      if (!list.empty() && list.back().empty()) out_ += ';';
    }
  }

 private:
  template <class Number, class... Format>
  void put(Number number, Format... format) const {
    std::array<char, 32> text;  // the longest number has 24 characters
    char* const end = text.data() + text.size();
    out_.append(text.data(), std::to_chars(text.data(), end, number, format...).ptr);
  }
  template <class T>
  void put_item(const T& item) const {
    (*this)(item);
  }
  void put_item(const std::string& item) const {
    for (std::size_t i = 0; i < item.size(); ++i) {
      const char c = item[i];
      const bool is_end = i == 0 || i + 1 == item.size();
      if (c == ';' || c == '\\' || (is_end && is_blank(c))) out_ += '\\';
      out_ += c;
    }
  }

  std::string& out_;
};

#define DOUBLE_PATTERN R"(([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+\-]?[0-9]+)?)"
#define LIST_PATTERN(item) R"([\s;,]*()" item R"(([\s;,]+)" item R"()*)?[\s;,]*)"

struct TypeRow {
  std::string_view name;
  std::string_view expected;
  std::optional<Value> (*parse)(std::string_view);
  SchemaType schema;
};

// In the order of ValueType.
constexpr TypeRow kTypes[] = {
    {"int or double", "a number", parse_number, {"double"}},
    {"bool", "true or false", parse_as<bool>, {"xs:boolean"}},
    {"int", "a whole number", parse_as<std::int64_t>, {"int", "xs:long"}},
    {"double",
     "a number",
     parse_as<double>,
     {"double", "xs:double", R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)"}},
    {"string",
     "text",
     parse_as<std::string>,
     {"text", "xs:string", R"(([^{](.|\s)*)?|\{((.|\s)*[^}])?|\{\})", "Any text that is not {…}."}},
    {"list of double",
     "a list such as 0.25;0.5",
     parse_as<std::vector<double>>,
     {"list", "xs:string", LIST_PATTERN(R"([+\-]?)" DOUBLE_PATTERN),
      "Numbers, separated by ; or , or whitespace."}},
    {"list of int",
     "a list such as 1;2",
     parse_as<std::vector<std::int64_t>>,
     {"intList", "xs:string", LIST_PATTERN(R"([+\-]?[0-9]+)"),
      "Whole numbers, separated by ; or , or whitespace."}},
    {"list of bool",
     "a list such as true;false",
     parse_as<std::vector<Flag>>,
     {"boolList", "xs:string", LIST_PATTERN("(true|false|1|0)"),
      "true or false, separated by ; or , or whitespace."}},
    {"list of string", "a list such as a;b", parse_as<std::vector<std::string>>, {"text"}},
    {"object", "an object", parse_as<Object>, {"text"}}};

static_assert(std::size(kTypes) == std::variant_size_v<Value>, "a row for each type");

const TypeRow& row(ValueType type) {
  return kTypes[static_cast<unsigned>(type)];
}

}  // namespace

bool holds(const Value& value, ValueType type) {
  const auto held = static_cast<ValueType>(value.index());
  if (type != ValueType::Number) return held == type && value.index() != 0;
  return held == ValueType::Int || held == ValueType::Double;
}

std::string_view to_string(ValueType type) {
  return row(type).name;
}

std::string_view expected_text(ValueType type) {
  return row(type).expected;
}

std::optional<bool> parse_flag(std::string_view text) {
  for (const std::string_view word : {"1", "true", "True", "TRUE"}) {
    if (text == word) return true;
  }
  for (const std::string_view word : {"0", "false", "False", "FALSE"}) {
    if (text == word) return false;
  }
  return std::nullopt;
}

std::optional<double> parse_double(std::string_view text) {
  const auto number = parse_digits<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::int64_t> parse_int(std::string_view text) {
  return parse_digits<std::int64_t>(text);
}

std::optional<Value> parse_value(ValueType type, std::string_view text) {
  return row(type).parse(text);
}

void append_text(const Value& value, std::string& out) {
  std::visit(Writer(out), value);
}

std::string to_text(const Value& value) {
  std::string text;
  append_text(value, text);
  return text;
}

const SchemaType& schema_type(ValueType type) {
  return row(type).schema;
}

std::span<const ValueType> all_value_types() {
  static constexpr auto kAll = [] {
    std::array<ValueType, std::size(kTypes)> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<ValueType>(i);
    return all;
  }();
  return kAll;
}

}  // namespace lockstep::host
