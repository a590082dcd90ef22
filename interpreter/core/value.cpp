#include "core/value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <iterator>

namespace lockstep {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<bool> parse_bool(std::string_view text) {
  text = trim(text);
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  return std::nullopt;
}

std::optional<std::vector<double>> parse_list(std::string_view text) {
  std::vector<double> list;
  constexpr std::string_view kSeparators = ";, \t\r\n";
  while (true) {
    const auto first = text.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) return list;
    text.remove_prefix(first);
    const auto length = std::min(text.find_first_of(kSeparators), text.size());
    const auto number = parse_double(text.substr(0, length));
    if (!number) return std::nullopt;
    list.push_back(*number);
    text.remove_prefix(length);
  }
}

template <class T>
std::optional<Value> wrap(std::optional<T> parsed) {
  if (!parsed) return std::nullopt;
  return Value(std::move(*parsed));
}

}  // namespace

std::string_view to_string(ValueType type) {
  constexpr std::string_view kNames[] = {"bool", "int", "double", "string", "list of double"};
  return kNames[static_cast<unsigned>(type)];
}

std::string_view expected_text(ValueType type) {
  constexpr std::string_view kTexts[] = {"true or false", "a whole number", "a number", "text",
                                         "a list such as 0.25;0.5"};
  return kTexts[static_cast<unsigned>(type)];
}

std::optional<double> parse_double(std::string_view text) {
  const auto number = parse_number<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::int64_t> parse_int(std::string_view text) {
  return parse_number<std::int64_t>(text);
}

std::optional<Value> parse_value(ValueType type, std::string_view text) {
  switch (type) {
    case ValueType::Bool:
      return wrap(parse_bool(text));
    case ValueType::Int:
      return wrap(parse_int(text));
    case ValueType::Double:
      return wrap(parse_double(text));
    case ValueType::String:
      return Value(std::string(text));
    case ValueType::DoubleList:
      return wrap(parse_list(text));
  }
  return std::nullopt;
}

void append_text(const Value& value, std::string& out) {
  struct Writer {
    std::string& out;
    void operator()(NoValue) const {}
    void operator()(bool flag) const { out += flag ? "true" : "false"; }
    void operator()(std::int64_t number) const {
      fmt::format_to(std::back_inserter(out), "{}", number);
    }
    void operator()(double number) const { fmt::format_to(std::back_inserter(out), "{}", number); }
    void operator()(const std::string& text) const { out += text; }
    void operator()(const std::vector<double>& list) const {
      fmt::format_to(std::back_inserter(out), "{}", fmt::join(list, ";"));
    }
  };
  std::visit(Writer{out}, value);
}

std::string to_text(const Value& value) {
  std::string text;
  append_text(value, text);
  return text;
}

}  // namespace lockstep
