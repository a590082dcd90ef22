#include "author/scaffold/port_value.h"

#include <fmt/format.h>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

struct Literal {
  bool is_python;
  std::string_view type;  // as the language has it

  std::string operator()(const NoValue&) const { return {}; }
  std::string operator()(const Object&) const { return {}; }
  std::string operator()(bool value) const {
    if (is_python) return value ? "True" : "False";
    return value ? "true" : "false";
  }
  std::string operator()(Flag value) const { return (*this)(value.is_set); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".e") == text.npos ? text + ".0" : text;
  }
  std::string operator()(const std::string& value) const {
    const std::string quoted = '"' + in_quotes(value) + '"';
    return is_python ? quoted : "std::string(" + quoted + ')';
  }
  template <class Item>
  std::string operator()(const std::vector<Item>& values) const {
    std::vector<std::string> items;
    for (const Item& item : values) items.push_back((*this)(item));
    const std::string list = joined(items, ", ");
    return is_python ? '[' + list + ']' : fmt::format("{}{{{}}}", type, list);
  }
};

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted;
}

std::string literal(const SourceLanguage& language, const PortType& type, std::string_view text) {
  const auto value =
      parse_value(type.type == ValueType::Number ? ValueType::Double : type.type, text);
  if (!value) return {};
  return std::visit(Literal{language.name == "python", type.text}, *value);
}

}  // namespace lockstep::host
