// Values of ports as JSON, in requests to programs and in their answers.
#pragma once

#include <string>
#include <string_view>

#include "base/core/value.h"
#include "base/json/reader.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// The value of the port; NoValue when it has none. After a refusal the caller has an error.
Value port_value(const lockstep_caller& caller, std::uint32_t port);

// Equal, where -0.0 is not 0.0.
bool is_same(const Value& value, const Value& other);

// Nothing is "null".
void append_json_value(std::string& to, const Value& value);

// Sets the port to what the program has said. "" or what is wrong with it.
std::string set_port(const lockstep_caller& caller, std::uint32_t port, JsonValue value);

}  // namespace lockstep::host
