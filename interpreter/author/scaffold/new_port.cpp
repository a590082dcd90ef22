#include "author/scaffold/new_port.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/core/identifier.h"
#include "base/core/suggest.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kForm =
    "NAME:TYPE, NAME:TYPE=DEFAULT, out:NAME:TYPE or inout:NAME:TYPE, such as speed:double=0.5";

constexpr std::array<std::pair<std::string_view, PortDirection>, 3> kDirections{
    {{"in", PortDirection::Input},
     {"out", PortDirection::Output},
     {"inout", PortDirection::InOut}}};

// Types, as other languages call them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOtherWords{
    {{"float", "double"},
     {"real", "double"},
     {"integer", "int"},
     {"int64", "int"},
     {"boolean", "bool"},
     {"text", "string"}}};

Result<ValueType> parse_type(std::string_view word) {
  std::vector<std::string_view> words;
  for (const ValueType type : all_value_types()) {
    if (type == ValueType::Object) continue;
    const std::string_view name = type == ValueType::Number ? "number" : to_string(type);
    if (name == word) return type;
    words.push_back(name);
  }
  const auto* const other =
      std::ranges::find(kOtherWords, word, &std::pair<std::string_view, std::string_view>::first);
  const std::string hint = other == kOtherWords.end()
                               ? suggest(word, words, "the types")
                               : fmt::format("did you mean '{}'?", other->second);
  return problem(fmt::format("'{}' is not a type of a port", word), hint);
}

// The part up to the next colon, which is taken from `text`.
std::string_view take(std::string_view& text) {
  const auto colon = std::min(text.find(':'), text.size());
  const std::string_view part = text.substr(0, colon);
  text.remove_prefix(std::min(colon + 1, text.size()));
  return part;
}

Result<void> check_name(const NewPort& port) {
  if (!is_identifier(port.name) || port.name[0] == '_') {
    return problem(fmt::format("'{}' cannot be the name of a port", port.name),
                   fmt::format("a port is {}", kForm));
  }
  if (port.name == "name" || port.name == "ID") {
    return problem(fmt::format("no port can be called '{}'", port.name),
                   "each node of a tree has this attribute already");
  }
  return {};
}

Result<void> check_default(const NewPort& port) {
  if (!port.default_text) return {};
  if (port.direction == PortDirection::Output) {
    return problem(fmt::format("the output '{}' cannot have a default", port.name),
                   "an inout can: inout:NAME:TYPE=DEFAULT");
  }
  const ValueType type = port.type == ValueType::Number ? ValueType::Double : port.type;
  const std::string& text = *port.default_text;
  const bool is_key = text.size() > 1 && text.front() == '{' && text.back() == '}';
  if (is_key) {
    return problem(fmt::format("the default '{}' of port '{}' is an entry", text, port.name),
                   "a default is a constant; a tree gives the port an entry");
  }
  if (parse_value(type, text)) return {};
  return problem(
      fmt::format("the default '{}' of port '{}' is no {}", text, port.name, to_string(port.type)),
      fmt::format("expected {}", expected_text(port.type)));
}

}  // namespace

Result<NewPort> parse_port(std::string_view text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (std::ranges::any_of(text, is_control)) {
    return problem("a port has a line break or another control character", "leave it out");
  }
  NewPort port;
  std::string_view rest = text.substr(0, text.find('='));
  if (rest.size() < text.size()) port.default_text = text.substr(rest.size() + 1);
  std::string_view word = take(rest);
  const auto* const direction =
      std::ranges::find(kDirections, word, &std::pair<std::string_view, PortDirection>::first);
  if (direction != kDirections.end() && rest.find(':') != rest.npos) {
    port.direction = direction->second;
    word = take(rest);
  }
  port.name = word;
  if (rest.empty()) {
    return problem(fmt::format("'{}' is not a port", text), fmt::format("a port is {}", kForm));
  }
  const auto type = parse_type(rest);
  if (!type) return tl::unexpected(type.error());
  port.type = *type;
  if (const auto name = check_name(port); !name) return tl::unexpected(name.error());
  if (const auto value = check_default(port); !value) return tl::unexpected(value.error());
  if (port.type == ValueType::Number && port.direction != PortDirection::Input) {
    return problem(fmt::format("the output '{}' cannot be a number", port.name),
                   "what is set is an int or a double");
  }
  return port;
}

}  // namespace lockstep::host
