#include "leaves/plugin/contract/descriptor_port.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "base/core/identifier.h"
#include "base/core/parameter_value.h"
#include "base/core/value_types.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/object_type.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kSizeIn10 = offsetof(lockstep_port, doc) + sizeof(lockstep_port::doc);

constexpr lockstep_type kTypeCount = std::variant_size_v<Value> - 1;

// The types of the contract have the numbers of ours.
std::optional<ValueType> type_of(lockstep_type type) {
  if (type == LOCKSTEP_NUMBER) return ValueType::Number;
  if (type == LOCKSTEP_ANY) return ValueType::String;
  if (type < 1 || type > kTypeCount) return std::nullopt;
  return static_cast<ValueType>(type);
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::optional<Problem> check_name(const lockstep_port& port, std::span<const Parameter> others) {
  if (port.name == nullptr) return Problem{"has no name", "set lockstep_port::name"};
  const std::string_view name = port.name;
  std::string without_dots(name);
  std::ranges::replace(without_dots, '.', '-');
  if (!is_attribute_name(without_dots)) {
    return Problem{fmt::format("is named '{}'", name),
                   "a port's name is a letter, then letters, digits, '_', '-' and '.'"};
  }
  if (name == "name" || name == "ID") {
    return Problem{fmt::format("is named '{}', an attribute that every node has", name),
                   "give the port another name"};
  }
  if (std::ranges::any_of(others, [&](const Parameter& other) { return other.name == name; })) {
    return Problem{fmt::format("is named '{}', as a port before it", name),
                   "give each port of a leaf its own name"};
  }
  return std::nullopt;
}

std::optional<Problem> check_fixed(const lockstep_port& port) {
  if ((port.flags & LOCKSTEP_FIXED) == 0) return std::nullopt;
  const bool has_entry = port.direction != LOCKSTEP_INPUT || port.type == LOCKSTEP_OBJECT ||
                         (port.flags & LOCKSTEP_DEFAULT_ENTRY) != 0;
  if (!has_entry) return std::nullopt;
  return Problem{fmt::format("('{}') is fixed, but is not an input with a constant", port.name),
                 "a fixed port is an input that is not an object and has no default entry"};
}

bool has_default_entry(const lockstep_port& port) {
  return port.default_value != nullptr && (port.flags & LOCKSTEP_DEFAULT_ENTRY) != 0;
}

std::optional<Problem> read_default_entry(const lockstep_port& port, Parameter& parameter) {
  const std::string_view text = port.default_value;
  const bool is_key = text.size() > 2 && text.front() == '{' && text.back() == '}';
  if (!is_key) {
    return Problem{
        fmt::format("('{}') has the default '{}', expected an entry", port.name, printable(text)),
        "write {key}, or {=} for the entry of the port's name"};
  }
  parameter.default_key = text == "{=}" ? parameter.name : text.substr(1, text.size() - 2);
  return std::nullopt;
}

std::optional<Problem> check_default(const lockstep_port& port, const Parameter& parameter) {
  if (port.default_value == nullptr) return std::nullopt;
  const std::string_view text = port.default_value;
  if (port.direction == LOCKSTEP_OUTPUT) {
    return Problem{fmt::format("('{}') is an output with a default", port.name),
                   "only an input or inout port has a default"};
  }
  const bool is_key = text.size() > 1 && text.front() == '{' && text.back() == '}';
  const auto value = parse_value(parameter.type, text);
  if (is_key || !value) {
    return Problem{fmt::format("('{}') has the default '{}', expected {}", port.name, text,
                               expected_text(parameter.type)),
                   "a default is a constant, written as in a tree"};
  }
  if (auto refused = refuse_value(parameter, *value)) {
    return Problem{
        fmt::format("('{}') has the default '{}': {}", port.name, text, refused->message),
        std::move(refused->hint)};
  }
  return std::nullopt;
}

std::vector<std::string_view> words_of(const char* choices) {
  std::vector<std::string_view> words;
  for (std::string_view rest = text_or_empty(choices); !rest.empty();) {
    const auto length = std::min(rest.find(';'), rest.size());
    words.push_back(rest.substr(0, length));
    rest.remove_prefix(std::min(length + 1, rest.size()));
  }
  return words;
}

std::optional<Problem> check_choices(const lockstep_port& port, ValueType type,
                                     std::vector<std::string_view> words) {
  if (words.empty()) return std::nullopt;
  if (type != ValueType::String) {
    return Problem{fmt::format("('{}') has choices, but is not a string", port.name),
                   "only a LOCKSTEP_STRING has choices"};
  }
  std::ranges::sort(words);
  const bool has_twice = std::ranges::adjacent_find(words) != words.end();
  const bool has_odd = std::ranges::any_of(words, [](std::string_view word) {
    return word.empty() || word != printable(word) || word.front() == ' ' || word.back() == ' ' ||
           word.front() == '{';
  });
  if (!has_twice && !has_odd) return std::nullopt;
  return Problem{fmt::format("('{}') has the choices '{}'", port.name, printable(port.choices)),
                 "choices are different words, separated by ';' only"};
}

bool has_range(const lockstep_port& port) {
  return port.min != 0 || port.max != 0;
}

std::optional<Problem> check_range(const lockstep_port& port, ValueType type) {
  if (!has_range(port)) return std::nullopt;
  if (!has_numbers(type)) {
    return Problem{fmt::format("('{}') has min and max, but is not a number", port.name),
                   "only numbers and lists of them have min and max"};
  }
  if (port.min <= port.max) return std::nullopt;
  return Problem{fmt::format("('{}') has min {} and max {}", port.name, port.min, port.max),
                 "min is at most max; use HUGE_VAL for no upper end"};
}

std::optional<Problem> check(const lockstep_port& port, std::span<const Parameter> others) {
  if (auto refusal = check_name(port, others)) return refusal;
  const auto type = type_of(port.type);
  if (!type) {
    return Problem{
        fmt::format("('{}') has type {}", port.name, port.type),
        fmt::format("use LOCKSTEP_NUMBER, LOCKSTEP_ANY or one of the types 1 to {}", kTypeCount)};
  }
  if (port.direction < LOCKSTEP_INPUT || port.direction > LOCKSTEP_INOUT) {
    return Problem{fmt::format("('{}') has direction {}", port.name, port.direction),
                   "use LOCKSTEP_INPUT, LOCKSTEP_OUTPUT or LOCKSTEP_INOUT, 1 to 3"};
  }
  if (type == ValueType::Number && port.direction != LOCKSTEP_INPUT) {
    return Problem{fmt::format("('{}') is an output of type number", port.name),
                   "an output is an int or a double, so that others know what they read"};
  }
  if (auto refusal = check_fixed(port)) return refusal;
  return check_range(port, *type);
}

}  // namespace

bool is_attribute_name(std::string_view text) {
  const auto is_other = [](char c) { return c == '-' || static_cast<unsigned char>(c) >= 0x80; };
  std::string plain(text);
  std::replace_if(plain.begin(), plain.end(), is_other, 'x');
  return is_identifier(plain) && text.front() != '_' && text.front() != '-' &&
         printable(text) == text;
}

bool is_plugin_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-';
  });
}

std::optional<Problem> read_port(const lockstep_port* from, std::string_view plugin,
                                 std::span<const Parameter> others,
                                 std::vector<std::string_view>& choices, Parameter& port) {
  if (from == nullptr) return Problem{"is NULL", "list port_count ports"};
  if (from->struct_size < kSizeIn10) {
    return Problem{
        fmt::format("has struct_size {}, expected at least {}", from->struct_size, kSizeIn10),
        "set it to sizeof(lockstep_port)"};
  }
  const lockstep_port copy = covered_copy(from, from->struct_size);
  if (auto refusal = check(copy, others)) return refusal;
  const ObjectType* object = nullptr;
  if (copy.type == LOCKSTEP_OBJECT) {
    auto found = read_object_type(copy.object, plugin);
    if (!found) {
      return Problem{fmt::format("('{}') {}", copy.name, found.error().message),
                     found.error().hint};
    }
    if (copy.default_value != nullptr && !has_default_entry(copy)) {
      return Problem{fmt::format("('{}') has a default, but carries objects", copy.name),
                     "an object has no default"};
    }
    object = *found;
  }
  choices = words_of(copy.choices);
  if (auto refusal = check_choices(copy, *type_of(copy.type), choices)) return refusal;
  port = Parameter{.name = copy.name,
                   .type = *type_of(copy.type),
                   .doc = text_or_empty(copy.doc),
                   .required = copy.default_value == nullptr && copy.direction != LOCKSTEP_OUTPUT &&
                               (copy.flags & LOCKSTEP_OPTIONAL) == 0,
                   .direction = static_cast<Direction>(copy.direction - 1),
                   .unit = text_or_empty(copy.unit),
                   .choices = choices,
                   .object = object,
                   .constant = (copy.flags & LOCKSTEP_FIXED) != 0,
                   .is_generic = copy.type == LOCKSTEP_ANY};
  if (has_range(copy)) port.range = {.min = copy.min, .max = copy.max};
  if (has_default_entry(copy)) return read_default_entry(copy, port);
  if (copy.default_value != nullptr) port.default_text = copy.default_value;
  return check_default(copy, port);
}

}  // namespace lockstep::host
