#include "leaves/remote/json_lines/port_fact.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/core/value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

lockstep_type type_of(std::string_view name) {
  if (name == "number") return LOCKSTEP_NUMBER;
  for (const ValueType type : all_value_types()) {
    if (type == ValueType::Number || type == ValueType::Object || to_string(type) != name) continue;
    return static_cast<lockstep_type>(type);  // the types of the contract have the numbers of ours
  }
  throw JsonError(
      fmt::format("the type of a port is '{}', expected bool, int, double, string, "
                  "number, or 'list of ' and one of the first four",
                  brief(name)));
}

// A scalar as it is written in a tree.
std::string scalar_text(JsonValue value) {
  std::string_view text;
  bool flag = false;
  std::int64_t whole = 0;
  double number = 0;
  if (value.get(text)) return std::string(text);
  if (value.get(flag)) return flag ? "true" : "false";
  if (value.get(whole)) return std::to_string(whole);
  if (value.get(number)) return fmt::format("{}", number);
  throw JsonError("a default is not a string, a number, true or false");
}

}  // namespace

int number_of(std::string_view what, std::string_view word,
              std::initializer_list<std::pair<std::string_view, int>> words) {
  std::vector<std::string_view> expected;
  for (const auto& [known, number] : words) {
    if (known == word) return number;
    expected.push_back(known);
  }
  throw JsonError(fmt::format("the {} is '{}', expected {}", what, brief(word), listed(expected)));
}

std::function<void(JsonValue)> into_flag(bool& flag) {
  return [&flag](JsonValue value) {
    if (!value.get(flag)) throw JsonError("a flag is not true or false");
  };
}

const char* keep_or_null(OwnedDescriptors& tables, std::string_view text) {
  return text.empty() ? nullptr : tables.keep(text);
}

namespace {

void read_fact(JsonValue value, lockstep_port& port, OwnedDescriptors& tables) {
  const auto into_text = [&](const char*& text) {
    return [&](JsonValue it) { text = keep_or_null(tables, it.text()); };
  };
  std::string type, direction = "input";
  std::vector<std::string> choices;
  double least = -HUGE_VAL, most = HUGE_VAL;
  bool optional = false, fixed = false;
  value.object().read(
      {{"name", into_text(port.name)},
       {"type", into(type)},
       {"direction", into(direction), kMayLack},
       {"default", [&](JsonValue it) { port.default_value = tables.keep(scalar_text(it)); },
        kMayLack},
       {"unit", into_text(port.unit), kMayLack},
       {"doc", into_text(port.doc), kMayLack},
       {"choices", into(choices), kMayLack},
       {"min", into(least), kMayLack},
       {"max", into(most), kMayLack},
       {"optional", into_flag(optional), kMayLack},
       {"fixed", into_flag(fixed), kMayLack}});
  port.type = type_of(type);
  port.direction = number_of(
      "direction of a port", direction,
      {{"input", LOCKSTEP_INPUT}, {"output", LOCKSTEP_OUTPUT}, {"inout", LOCKSTEP_INOUT}});
  port.choices = keep_or_null(tables, joined(choices, ";"));
  const bool is_limited = least != -HUGE_VAL || most != HUGE_VAL;
  port.min = is_limited ? least : 0;
  port.max = is_limited ? most : 0;
  if (optional) port.flags |= LOCKSTEP_OPTIONAL;
  if (fixed) port.flags |= LOCKSTEP_FIXED;
}

}  // namespace

void read_port_fact(JsonValue value, OwnedDescriptors& tables) {
  lockstep_port& port = tables.add_port();
  try {
    read_fact(value, port, tables);
  } catch (const NotJson&) {
    throw;
  } catch (const JsonError& error) {
    if (port.name == nullptr) throw JsonError(fmt::format("a port: {}", error.what()));
    throw JsonError(fmt::format("port '{}': {}", brief(port.name), error.what()));
  }
}

}  // namespace lockstep::host
