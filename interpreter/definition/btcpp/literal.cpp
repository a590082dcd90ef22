#include "definition/btcpp/literal.h"

#include <algorithm>
#include <charconv>

#include "core/parameter_value.h"

namespace lockstep::btcpp {
namespace {

template <class Number>
bool is_all(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::optional<Value> read_literal(ValueType type, const ObjectType* object, std::string_view text) {
  return parse_value(type, object, text);
}

std::string_view ignored_tail(const Parameter& /*parameter*/, std::string_view /*text*/) {
  return {};
}

std::optional<bool> read_bool(std::string_view text) {
  constexpr std::string_view kTrue[] = {"1", "true", "TRUE", "True"};
  constexpr std::string_view kFalse[] = {"0", "false", "FALSE", "False"};
  if (std::ranges::find(kTrue, text) != std::end(kTrue)) return true;
  if (std::ranges::find(kFalse, text) != std::end(kFalse)) return false;
  return std::nullopt;
}

ValueType literal_type(std::string_view text) {
  if (is_all<std::int64_t>(text)) return ValueType::Int;
  return is_all<double>(text) ? ValueType::Double : ValueType::String;
}

}  // namespace lockstep::btcpp
