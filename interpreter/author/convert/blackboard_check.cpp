#include "author/convert/blackboard_check.h"

#include <fmt/format.h>

#include "author/convert/literal.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "dialect/btcpp/words.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kTag = "BlackboardCheck";
constexpr std::string_view kFirst = "value_A", kSecond = "value_B",
                           kMismatch = "return_on_mismatch";

std::string_view node_of(std::string_view result) {
  if (result == "SUCCESS") return "AlwaysSuccess";
  return result == "FAILURE" ? "AlwaysFailure" : std::string_view();
}

ValueType compared_type(std::string_view type) {
  if (type.ends_with("Int")) return ValueType::Int;
  if (type.ends_with("Double")) return ValueType::Double;
  return type.ends_with("Bool") ? ValueType::Bool : ValueType::String;
}

}  // namespace

bool is_blackboard_check(std::string_view type) {
  const bool is_one = type.starts_with(kTag);
  const std::string_view values = is_one ? type.substr(kTag.size()) : type;
  return is_one &&
         (values == "Int" || values == "Double" || values == "Bool" || values == "String");
}

bool is_attribute_of_check(std::string_view name) {
  return name == kFirst || name == kSecond || name == kMismatch;
}

ConvertedCheck converted_check(const Document& document, std::uint32_t element,
                               std::string_view type) {
  ConvertedCheck converted{.place = document.elements()[element].place};
  const auto fail = [&](std::string problem, std::string hint, Place place) {
    return ConvertedCheck{.problem = std::move(problem), .hint = std::move(hint), .place = place};
  };
  std::string operands[2];
  for (const bool is_second : {false, true}) {
    const std::string_view name = is_second ? kSecond : kFirst;
    const Attribute* const it = document.find_attribute(element, name);
    if (it == nullptr) {
      return fail(fmt::format("a {} without '{}'", type, name), "give it both values",
                  converted.place);
    }
    std::string& operand = operands[is_second ? 1 : 0];
    if (const auto key = btcpp::key_of(it->value, it->name); !key.empty()) {
      if (!is_identifier(key)) {
        return fail(fmt::format("the key '{}'", brief(key)),
                    fmt::format("a key is {}", kIdentifierRule), it->place);
      }
      operand = key;
    } else {
      operand = literal_of(it->value, compared_type(type));
    }
    if (operand.empty()) {
      return fail(fmt::format("the value '{}'", brief(it->value)),
                  "a text in a script has ' or \" in it, not both", it->place);
    }
  }
  converted.code = fmt::format("{} == {}", operands[0], operands[1]);
  const Attribute* const mismatch = document.find_attribute(element, kMismatch);
  const std::string_view result = mismatch == nullptr ? "" : mismatch->value;
  converted.otherwise = node_of(result);
  if (!converted.otherwise.empty()) return converted;
  return fail(mismatch == nullptr ? fmt::format("a {} without '{}'", type, kMismatch)
                                  : fmt::format("{}=\"{}\"", kMismatch, brief(result)),
              "SUCCESS and FAILURE can be",
              mismatch == nullptr ? converted.place : mismatch->place);
}

}  // namespace lockstep::host
