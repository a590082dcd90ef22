#include "author/convert/set_blackboard.h"

#include <fmt/format.h>

#include "author/convert/literal.h"
#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "dialect/btcpp/words.h"

namespace lockstep::host {
ConvertedSetter setter_to_ours(const Document& document, std::uint32_t element,
                               std::optional<ValueType> type) {
  const auto fail = [](std::string problem, std::string hint, Place place) {
    return ConvertedSetter{.problem = std::move(problem), .hint = std::move(hint), .place = place};
  };
  const Attribute* target = document.find_attribute(element, "output_key");
  const Attribute* value = document.find_attribute(element, "value");
  const Place place = document.elements()[element].place;
  if (target == nullptr || value == nullptr) {
    return fail("a SetBlackboard without 'output_key' or 'value'", "give it both", place);
  }
  const std::string_view key = target->value;
  if (const auto holder = btcpp::key_of(key, target->name); !holder.empty()) {
    return fail(fmt::format("an entry whose name is in the entry '{}'", brief(holder)),
                fmt::format("if '{0}' itself is meant, write output_key=\"{0}\"", brief(holder)),
                target->place);
  }
  const auto bad_key = [&](std::string_view name, const Attribute& at) {
    return fail(fmt::format("the key '{}'", brief(name)),
                fmt::format("a key is {}", kIdentifierRule), at.place);
  };
  if (!is_identifier(key)) return bad_key(key, *target);
  if (const auto from = btcpp::key_of(value->value, value->name); !from.empty()) {
    if (!is_identifier(from)) return bad_key(from, *value);
    return {.code = fmt::format("{} := {}", key, from), .is_entry = true};
  }
  const std::string literal = literal_of(value->value, type);
  if (literal.empty()) {
    return fail(fmt::format("the value '{}'", brief(value->value)),
                "a text in a script has ' or \" in it, not both", value->place);
  }
  const bool is_text = literal.starts_with('\'') || literal.starts_with('"');
  return {.code = fmt::format("{} := {}", key, literal), .is_text = is_text};
}

}  // namespace lockstep::host
