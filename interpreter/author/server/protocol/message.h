// A message of JSON-RPC 2.0 from the client, and what is answered.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "base/core/problem.h"
#include "base/json/json.h"
#include "base/json/reader.h"

namespace lockstep::host {

enum class RpcError : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  NotInitialized = -32002,
  RequestCancelled = -32800,
};

// monostate: a notification has none.
using RequestId = std::variant<std::monostate, std::int64_t, std::string>;

struct Message {
  std::string method;  // "": it is an answer to the server
  RequestId id = {};
  std::string body = {};  // all of it, from which the params are read

  bool is_request() const { return !std::holds_alternative<std::monostate>(id); }
};

// A JsonError is thrown for what is no message.
Message read_message(JsonReader& reader, std::string body);

// Calls `use` with the params, which may be in any order with the other members. Without params, or
// if they are no object, a JsonError is thrown.
void read_params(JsonReader& reader, Message& message, const std::function<void(JsonObject)>& use);

// The id that a notification names in this field.
RequestId cancelled_id(JsonReader& reader, Message& message, std::string_view field);
// As JSON.
Json json_of(const RequestId& id);

std::string answer(const RequestId& id, Json result);
std::string refusal(const RequestId& id, RpcError error, std::string_view message);
std::string notification(std::string_view method, Json params);
// A request of the server.
std::string request(std::int64_t id, std::string_view method, Json params);

}  // namespace lockstep::host
