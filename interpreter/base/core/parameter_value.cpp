#include "base/core/parameter_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/core/value_types.h"  // IWYU pragma: keep: a concept
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// The first number of a value that the range does not allow.
class OutOfRange {
 public:
  explicit OutOfRange(const Range& range) : range_(range) {}

  template <class T>
  std::optional<double> operator()(const T& /*no number*/) const {
    return std::nullopt;
  }
  template <IsNumber Number>
  std::optional<double> operator()(const Number& given) const {
    const auto number = static_cast<double>(given);
    const bool above = range_.min_excluded ? number > range_.min : number >= range_.min;
    return above && number <= range_.max ? std::nullopt : std::optional(number);
  }
  template <class T>
  std::optional<double> operator()(const std::vector<T>& list) const {
    for (const T& item : list) {
      if (const auto number = (*this)(item)) return number;
    }
    return std::nullopt;
  }

 private:
  const Range& range_;
};

}  // namespace

std::string_view type_name(ValueType type, const ObjectType* object) {
  return type == ValueType::Object ? object->name() : to_string(type);
}

std::optional<Value> parse_value(ValueType type, const ObjectType* object, std::string_view text) {
  if (type != ValueType::Object) return parse_value(type, text);
  if (!object->has_from_text()) return std::nullopt;
  auto made = object->from_text(text);
  if (!made) return std::nullopt;
  return Value(std::move(*made));
}

std::string expected_text(ValueType type, const ObjectType* object) {
  if (type != ValueType::Object) return std::string(expected_text(type));
  if (object->has_from_text()) return fmt::format("the text of a {}", object->name());
  return fmt::format("an entry {{key}} that carries a {}", object->name());
}

std::string why_no_object(const ObjectType* object, std::string_view text) {
  if (object == nullptr || !object->has_from_text()) return {};
  const auto made = object->from_text(text);
  if (made || made.error().message.empty()) return {};
  return "its plugin reports: " + made.error().message;
}

std::optional<RuleBreak> refuse_value(const Parameter& parameter, const Value& value) {
  if (const auto number = std::visit(OutOfRange(parameter.range), value)) {
    return RuleBreak{
        .message = fmt::format("{} is outside the range of '{}'", *number, parameter.name),
        .hint = "it must be " + range_text(parameter.range)};
  }
  if (parameter.choices.empty()) return std::nullopt;
  const auto* word = std::get_if<std::string>(&value);
  if (word == nullptr || std::ranges::find(parameter.choices, *word) != parameter.choices.end()) {
    return std::nullopt;
  }
  return RuleBreak{
      .message = fmt::format("'{}' is not a value of '{}'", brief(*word), parameter.name),
      .hint = "it must be one of " + listed(parameter.choices)};
}

bool takes_text(const Parameter& parameter, std::string_view text) {
  const auto value = parse_value(parameter.type, parameter.object, text);
  return value && !refuse_value(parameter, *value);
}

Value sample_value(const Parameter& parameter) {
  if (parameter.default_text) {
    return parse_value(parameter.type, *parameter.default_text).value_or(Value());
  }
  if (!parameter.choices.empty()) return std::string(parameter.choices.front());
  const auto [min, max, min_excluded] = parameter.range;
  std::vector<std::string> texts{"1", "0.5", "0", "-1", "100", "true"};
  for (const double number : {min, std::ceil(min), max, std::floor(max), (min + max) / 2})
    if (std::isfinite(number)) texts.push_back(to_text(Value(number)));
  for (const std::string& text : texts) {
    const auto value = parse_value(parameter.type, text);
    if (value && !refuse_value(parameter, *value)) return *value;
  }
  return {};
}

ListErrors list_errors(const NodeType& type, const Parameter& parameter, std::string_view text) {
  constexpr std::size_t kMostTold = 20;
  ListErrors errors;
  std::vector<double> numbers;
  constexpr std::string_view kSeparators = "; ,\t\r\n";
  for (auto begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos;) {
    const auto end = std::min(text.find_first_of(kSeparators, begin), text.size());
    const std::string_view item = text.substr(begin, end - begin);
    begin = text.find_first_not_of(kSeparators, end);
    if (const auto number = parse_double(item)) {
      numbers.push_back(*number);
    } else if (errors.no_numbers.size() < kMostTold) {
      errors.no_numbers.push_back(item);
    }
  }
  std::set<double> told;
  std::erase_if(numbers, [&](double number) {
    auto refused = refuse_value(parameter, Value(number));
    if (!refused) return false;
    if (told.size() < kMostTold && told.insert(number).second) {
      errors.refused.push_back(*std::move(refused));
    }
    return true;
  });
  if (type.rule == nullptr) return errors;
  const auto place = static_cast<std::size_t>(&parameter - type.parameters.data());
  std::vector<Value> values(type.parameters.size());
  values[place] = std::move(numbers);
  auto broken = type.rule({.values = values, .children = 0});
  if (broken && broken->parameter == static_cast<int>(place)) {
    errors.refused.push_back(*std::move(broken));
  }
  return errors;
}

std::string refusal_text(const RuleBreak& why, std::string_view parameter, const Value& value,
                         std::string_view entry) {
  return fmt::format("{}: '{}' is '{}', from the entry '{{{}}}'{}{}", why.message, parameter,
                     brief(to_text(value)), brief(entry), why.hint.empty() ? "" : "; ", why.hint);
}

std::string range_text(const Range& range) {
  const bool has_min = std::isfinite(range.min);
  const bool has_max = std::isfinite(range.max);
  if (!has_min && !has_max) return {};
  const std::string_view above = range.min_excluded ? "more than" : "at least";
  if (has_min && has_max && !range.min_excluded) {
    return fmt::format("from {} to {}", range.min, range.max);
  }
  if (has_min && has_max) return fmt::format("{} {}, at most {}", above, range.min, range.max);
  if (has_min) return fmt::format("{} {}", above, range.min);
  return fmt::format("at most {}", range.max);
}

}  // namespace lockstep::host
