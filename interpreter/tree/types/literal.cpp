#include "tree/types/literal.h"

#include <charconv>

namespace lockstep::host {
namespace {

template <class Number>
bool is_all(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

ValueType literal_type(std::string_view text) {
  if (is_all<std::int64_t>(text)) return ValueType::Int;
  return is_all<double>(text) ? ValueType::Double : ValueType::String;
}

}  // namespace lockstep::host
