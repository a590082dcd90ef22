#include "author/server/protocol/message.h"

namespace lockstep::host {
namespace {

RequestId id_in(JsonValue value) {
  std::int64_t number = 0;
  std::string_view text;
  if (value.get(number)) return number;
  if (value.get(text)) return std::string(text);
  if (value.is_null()) return {};
  throw JsonError("'id' is neither a whole number nor a text");
}

}  // namespace

Json json_of(const RequestId& id) {
  if (const auto* number = std::get_if<std::int64_t>(&id)) return *number;
  if (const auto* text = std::get_if<std::string>(&id)) return *text;
  return {};
}

Message read_message(JsonReader& reader, std::string body) {
  Message message;
  bool is_answer = false;
  const auto answers = [&](JsonValue value) {
    value.skip();
    is_answer = true;
  };
  reader.read(body, [&](JsonObject whole) {
    whole.read({{"method", into(message.method), kMayLack},
                {"id", [&](JsonValue value) { message.id = id_in(value); }, kMayLack},
                {"result", answers, kMayLack},
                {"error", answers, kMayLack}});
  });
  if (message.method.empty() && !is_answer) throw JsonError("'method' is missing");
  message.body = std::move(body);
  return message;
}

void read_params(JsonReader& reader, Message& message, const std::function<void(JsonObject)>& use) {
  reader.read(message.body, [&](JsonObject whole) {
    whole.read({{"params", [&](JsonValue params) { use(params.object()); }}});
  });
}

RequestId cancelled_id(JsonReader& reader, Message& message, std::string_view field) {
  RequestId id;
  read_params(reader, message, [&](JsonObject params) {
    params.read({{field, [&](JsonValue value) { id = id_in(value); }}});
  });
  return id;
}

std::string answer(const RequestId& id, Json result) {
  return Json{{"jsonrpc", "2.0"}, {"id", json_of(id)}, {"result", std::move(result)}}.text();
}

std::string refusal(const RequestId& id, RpcError error, std::string_view message) {
  Json reason{{"code", static_cast<int>(error)}, {"message", message}};
  return Json{{"jsonrpc", "2.0"}, {"id", json_of(id)}, {"error", std::move(reason)}}.text();
}

std::string notification(std::string_view method, Json params) {
  return Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}}.text();
}

std::string request(std::int64_t id, std::string_view method, Json params) {
  return Json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", std::move(params)}}
      .text();
}

}  // namespace lockstep::host
