#include "leaves/remote/json_lines/described_element.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/value.h"
#include "base/json/json.h"
#include "leaves/remote/json_lines/port_fact.h"
#include "leaves/remote/json_lines/port_json.h"

namespace lockstep::host {
namespace {

// The types of the contract have the numbers of ours.
ValueType type_of_port(const lockstep_leaf_type& type, std::string_view name) {
  const std::span ports(type.ports, type.port_count);
  const auto it =
      std::ranges::find(ports, name, [](auto* port) -> std::string_view { return port->name; });
  return it == ports.end() ? ValueType::String : static_cast<ValueType>((*it)->type);
}

}  // namespace

std::string describe_request(const lockstep_leaf_type& type, std::span<const FixedText> fixed) {
  std::string text = R"({"do":"describe","type":)";
  append_json(text, type.id);
  text += R"(,"fixed":{)";
  const char* between = "";
  for (const auto& [parameter, given] : fixed) {
    text += between;
    append_json(text, parameter);
    text += ':';
    append_json_value(text, parse_value(type_of_port(type, parameter), given).value_or(Value()));
    between = ",";
  }
  return text + "}}";
}

tl::expected<const lockstep_leaf_type*, ElementRefusal> read_described(
    std::string& answer, const lockstep_leaf_type& base, OwnedDescriptors& tables) {
  lockstep_leaf_type& type = tables.add_leaf();
  type = base;
  type.more_ports = nullptr;
  type.describe = nullptr;
  for (std::uint32_t i = 0; i < base.port_count; ++i) tables.add_port() = *base.ports[i];
  ElementRefusal refusal;
  bool has_ports = false, is_refused = false;
  JsonReader().read(answer, [&](JsonObject object) {
    object.read({{"ports",
                  [&](JsonValue ports) {
                    has_ports = true;
                    ports.each_item([&](JsonValue it) { read_port_fact(it, tables); });
                  },
                  kMayLack},
                 {"refused",
                  [&](JsonValue it) {
                    is_refused = true;
                    refusal.why.message = it.text();
                  },
                  kMayLack},
                 {"port", into(refusal.parameter), kMayLack},
                 {"hint", into(refusal.why.hint), kMayLack}});
  });
  if (is_refused && refusal.why.message.empty()) {
    refusal.why = {fmt::format("'{}' cannot be described, and gives no reason", base.id),
                   "the author of the plugin knows what it needs"};
  }
  if (is_refused) return tl::unexpected(std::move(refusal));
  if (!has_ports) throw JsonError("expected 'ports' or 'refused'");
  return &type;
}

Result<std::string> ask_to_describe(Conversation& conversation, std::string_view request) {
  if (request.size() > LineInput::kLongest) {
    return problem(
        fmt::format("reads lines of at most 1 MiB, and the request has {} bytes", request.size()));
  }
  auto answer = conversation.ask(std::string(request) + '\n', "describe");
  if (!answer) conversation.give_up("was killed, since it describes no element");
  return answer;
}

ElementRefusal undescribed(std::string_view id, const Problem& why) {
  return {{}, {fmt::format("'{}' cannot be described: its program {}", id, why.message), why.hint}};
}

}  // namespace lockstep::host
