#include "cli/tools/mcp/mcp_server.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <new>
#include <optional>

#include "base/core/suggest.h"
#include "base/core/version.h"
#include "base/core/wording.h"
#include "base/system/own_thread.h"
#include "cli/exit_code.h"
#include "cli/tools/mcp/resources.h"
#include "run/stop_signals.h"

namespace lockstep::host {
namespace {

constexpr RpcProtocol kModelContextProtocol{Framing::Lines, "notifications/cancelled", "requestId"};
// The newest first.
constexpr std::string_view kRevisions[] = {"2025-06-18", "2025-03-26", "2024-11-05"};
constexpr std::size_t kMostRunning = 4, kMostWaiting = 1000;

constexpr std::string_view kInstructions =
    "lockstep checks, verifies, tests and simulates behavior trees for robots. Write a tree as XML "
    "(resource lockstep://docs/nodes-and-attributes, tool nodes), then call check until it has no "
    "errors: apply the first edit of each message, or read its hint. Then verify it, with a leaf "
    "model of what the leaves may do, and simulate it. No tool uses the clock of a robot or writes "
    "a file of the workspace.";

// Of `params`, all that tools/call has, in any order.
struct CallParams {
  std::string name;
  ToolValues values;
  std::optional<Json> token = {};
};

std::optional<ToolNumber> tool_number(JsonValue value) {
  std::uint64_t count = 0;
  double number = 0;
  if (value.get(count)) return ToolNumber{fmt::format("{}", count)};
  if (!value.get(number)) return std::nullopt;
  const bool is_whole = std::floor(number) == number && std::abs(number) < 0x1p64;
  return ToolNumber{is_whole ? fmt::format("{:.0f}", number) : fmt::format("{}", number)};
}

ToolValue tool_value(JsonValue value) {
  std::string_view text;
  bool flag = false;
  if (value.get(text)) return std::string(text);
  if (value.get(flag)) return flag;
  if (auto number = tool_number(value)) return std::move(*number);
  if (!value.is_list()) throw JsonError("an argument is a string, a number, true, false or a list");
  std::vector<std::string> list;
  value.each_item([&](JsonValue item) { list.emplace_back(item.text()); });
  return list;
}

CallParams read_call(JsonReader& reader, Message& message) {
  CallParams call;
  const auto arguments = [&](JsonValue all) {
    if (all.is_null()) return;
    all.object().each_field([&](std::string_view name, JsonValue value) {
      std::string key(name);
      if (!value.is_null()) call.values[std::move(key)] = tool_value(value);
    });
  };
  const auto token = [&](JsonValue value) {
    std::string_view text;
    std::int64_t number = 0;
    if (value.get(text)) {
      call.token = Json(text);
    } else if (value.get(number)) {
      call.token = Json(number);
    } else {
      value.skip();
    }
  };
  read_params(reader, message, [&](JsonObject params) {
    params.read({{"name", into(call.name)},
                 {"arguments", arguments, kMayLack},
                 {"_meta",
                  [&](JsonValue it) {
                    it.object().read({{"progressToken", token, kMayLack}});
                  },
                  kMayLack}});
  });
  return call;
}

// One line of JSON: between its tokens, line ends are blanks, and within a text there are none.
std::string in_one_line(std::string json) {
  std::ranges::replace(json, '\n', ' ');
  std::ranges::replace(json, '\r', ' ');
  return json;
}

bool is_json(std::string text) {
  std::string object = fmt::format("{{\"it\":{}}}", std::move(text));
  try {
    JsonReader().read(object, [](JsonObject it) {
      it.each_field([](std::string_view, JsonValue value) { value.skip(); });
    });
    return true;
  } catch (const JsonError&) {
    return false;
  }
}

std::string why_it_ended(const ToolOutcome& outcome, const ToolFolders& folders) {
  switch (outcome.end) {
    case ToolOutcome::End::Time:
      return fmt::format("stopped after {} seconds, the limit of a call", folders.seconds);
    case ToolOutcome::End::Output:
      return "stopped: more output than a call may have";
    case ToolOutcome::End::Signal:
      return fmt::format("ended by the signal '{}'{}", strsignal(outcome.code),
                         outcome.code == SIGABRT || outcome.code == SIGSEGV
                             ? fmt::format("; the limit of memory is {} MiB", folders.memory_mib)
                             : "");
    case ToolOutcome::End::NotStarted:
      return fmt::format("cannot be started: {}", strerror(outcome.code));
    default:
      return "";
  }
}

std::string error_result(const RequestId& id, std::string_view text) {
  Json content = Json::array();
  content.push_back(Json{{"type", "text"}, {"text", text}});
  return answer(id, Json{{"content", std::move(content)}, {"isError", true}});
}

// The result of the command as it has printed it is the value of the tool's result.
std::string tool_result(const RequestId& id, const Tool& tool, ToolOutcome& outcome) {
  const std::string value = tool.gives == Tool::Gives::Text ? Json(outcome.out).text()
                                                            : in_one_line(std::move(outcome.out));
  const std::string structured =
      fmt::format("{{\"exit_code\":{},\"log\":{},\"{}\":{}}}", outcome.code,
                  Json(outcome.err).text(), tool.result, value);
  return fmt::format(
      "{{\"jsonrpc\":\"2.0\",\"id\":{},\"result\":{{\"content\":[{{\"type\":\"text\",\"text\":{}}}]"
      ","
      "\"structuredContent\":{},\"isError\":false}}}}",
      json_of(id).text(), Json(structured).text(), structured);
}

}  // namespace

McpServer::McpServer(ToolFolders folders, int input, int output)
    : folders_(std::move(folders)), connection_(input, output, kModelContextProtocol) {
  wake_.open();
  for (const int file : {wake_.reading.number(), wake_.writing.number()})
    fcntl(file, F_SETFL, O_NONBLOCK);
}

McpServer::~McpServer() {
  for (auto& [id, call] : calls_) call->process.cancel();
  for (auto& [id, call] : calls_)
    if (call->thread.joinable()) call->thread.join();
}

McpServer::Answer McpServer::answer_of(std::string_view method) {
  struct Row {
    std::string_view method;
    Answer answer;
  };
  static constexpr Row kRows[] = {
      {"initialize", &McpServer::initialize},
      {"ping", &McpServer::ping},
      {"tools/list", &McpServer::list_tools},
      {"resources/list", &McpServer::all_resources},
      {"resources/templates/list", &McpServer::no_templates},
      {"resources/read", &McpServer::one_resource},
  };
  const auto* const row = std::ranges::find(kRows, method, &Row::method);
  return row == std::end(kRows) ? nullptr : row->answer;
}

void McpServer::run() {
  while (true) {
    connection_.receive(wake_.reading.number(), Connection::Wait::Yes);
    while (connection_.has_message()) handle(connection_.take());
    take_events();
    start_calls();
    if (connection_.is_over() || StopSignals::received() != 0) return;
  }
}

void McpServer::handle(Message message) {
  if (message.method.empty()) return;  // an answer: nothing depends on it
  if (message.is_request()) return handle_request(message);
  if (message.method != kModelContextProtocol.cancel) return;
  try {
    cancel(message);
  } catch (const JsonError&) {  // a notification has no answer
  }
}

void McpServer::handle_request(Message& message) {
  const auto refuse = [&](RpcError error, std::string_view why) {
    connection_.send(refusal(message.id, error, why));
  };
  if (connection_.was_cancelled(message.id)) return;  // which has no answer
  if (!is_initialized_ && message.method != "initialize" && message.method != "ping")
    return refuse(RpcError::NotInitialized, "the first request must be 'initialize'");
  try {
    if (message.method == "tools/call") return call_tool(message);
    const Answer function = answer_of(message.method);
    if (function == nullptr) {
      return refuse(RpcError::MethodNotFound,
                    fmt::format("the method '{}' is unknown", brief(message.method)));
    }
    connection_.send(answer(message.id, (this->*function)(message)));
  } catch (const JsonError& error) {
    refuse(RpcError::InvalidParams, error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(RpcError::InternalError, error.what());
  }
}

Json McpServer::initialize(Message& message) {
  std::string revision;
  read_params(connection_.reader(), message, [&](JsonObject params) {
    params.read({{"protocolVersion", into(revision)}});
  });
  is_initialized_ = true;
  const auto* const known = std::ranges::find(kRevisions, revision);
  Json about{{"name", "lockstep"}, {"version", kVersion}};
  Json abilities{{"tools", Json::object()}, {"resources", Json::object()}};
  return {{"protocolVersion", known == std::end(kRevisions) ? kRevisions[0] : *known},
          {"capabilities", std::move(abilities)},
          {"serverInfo", std::move(about)},
          {"instructions", kInstructions}};
}

Json McpServer::ping(Message&) {
  return Json::object();
}

Json McpServer::list_tools(Message&) {
  Json all = Json::array();
  for (const Tool& it : tools()) all.push_back(json_of(it));
  return {{"tools", std::move(all)}};
}

Json McpServer::all_resources(Message&) {
  return list_resources();
}

Json McpServer::no_templates(Message&) {
  return {{"resourceTemplates", Json::array()}};
}

Json McpServer::one_resource(Message& message) {
  std::string uri;
  read_params(connection_.reader(), message, [&](JsonObject params) {
    params.read({{"uri", into(uri)}});
  });
  auto found = read_resource(uri, folders_.recording());
  if (!found) throw JsonError(fmt::format("there is no resource '{}'", brief(uri)));
  Json contents = Json::array();
  contents.push_back(
      Json{{"uri", uri}, {"mimeType", found->type}, {"text", std::move(found->text)}});
  return {{"contents", std::move(contents)}};
}

void McpServer::call_tool(Message& message) {
  CallParams params = read_call(connection_.reader(), message);
  const auto all = tools();
  const auto tool = std::ranges::find(all, params.name, &Tool::name);
  if (tool == all.end()) {
    std::vector<std::string_view> names;
    for (const Tool& it : all) names.push_back(it.name);
    const std::string hint = suggest(params.name, names, "the tools are");
    throw JsonError(fmt::format("there is no tool '{}'; {}", brief(params.name), hint));
  }
  if (calls_.contains(message.id)) throw JsonError("a request with this id is not answered yet");
  if (waiting_.size() >= kMostWaiting) throw JsonError("too many calls wait");
  auto call = std::make_unique<Call>();
  call->id = message.id;
  call->tool = &*tool;
  call->token = std::move(params.token);
  call->folder = folders_.scratch / fmt::format("{}", ++calls_made_);
  std::filesystem::create_directory(call->folder);
  auto command = command_of(*tool, params.values, folders_, call->folder);
  if (!command) {
    std::filesystem::remove_all(call->folder);
    const Problem& why = command.error();
    connection_.send(error_result(
        message.id, why.hint.empty() ? why.message : why.message + "\nhint: " + why.hint));
    return;
  }
  call->command = std::move(*command);
  waiting_.push_back(message.id);
  calls_[message.id] = std::move(call);
}

void McpServer::cancel(Message& message) {
  const auto it =
      calls_.find(cancelled_id(connection_.reader(), message, kModelContextProtocol.cancelled));
  if (it == calls_.end()) return;
  it->second->is_cancelled = true;
  if (std::erase(waiting_, it->first) > 0) return end(*it->second, {});
  it->second->process.cancel();
}

void McpServer::start_calls() {
  while (!waiting_.empty() && calls_.size() - waiting_.size() < kMostRunning) {
    start(*calls_.at(waiting_.front()));
    waiting_.pop_front();
  }
}

void McpServer::start(Call& call) {
  call.thread = own_thread([this, &call] {
    Event event{call.id, true};
    const ToolLimits limits{from_seconds(folders_.seconds), folders_.memory_mib << 20u};
    event.outcome = call.process.run(
        call.command.words, call.command.input, limits, [&](double seconds, std::string_view line) {
          post({.id = call.id, .seconds = seconds, .line = std::string(line)});
        });
    post(std::move(event));
  });
}

void McpServer::post(Event event) {
  {
    const Lock lock(mutex_);
    events_.push_back(std::move(event));
  }
  static_cast<void>(!::write(wake_.writing.number(), "", 1));
}

void McpServer::take_events() {
  std::array<char, 64> bytes;
  while (::read(wake_.reading.number(), bytes.data(), bytes.size()) > 0) {
  }
  rethrow_thread_failure();
  std::vector<Event> events;
  {
    const Lock lock(mutex_);
    events.swap(events_);
  }
  for (Event& it : events) {
    Call& call = *calls_.at(it.id);
    if (it.is_end) {
      end(call, std::move(it.outcome));
    } else if (call.token && !call.is_cancelled) {
      Json params{{"progressToken", *call.token}, {"progress", it.seconds}};
      if (!it.line.empty()) params.add("message", it.line);
      connection_.send(notification("notifications/progress", std::move(params)));
    }
  }
}

void McpServer::end(Call& call, ToolOutcome outcome) {
  if (call.thread.joinable()) call.thread.join();
  std::error_code unused;
  std::filesystem::remove_all(call.folder, unused);
  if (!call.is_cancelled) {
    const std::string why = why_it_ended(outcome, folders_);
    const bool is_text = call.tool->gives == Tool::Gives::Text;
    const bool has_result =
        why.empty() && (is_text ? outcome.code == kExitSuccess : is_json(outcome.out));
    if (has_result) {
      connection_.send(tool_result(call.id, *call.tool, outcome));
    } else {
      const std::string first = why.empty() ? fmt::format("exit code {}", outcome.code) : why;
      connection_.send(
          error_result(call.id, fmt::format("{}: {}\n{}", call.tool->name, first, outcome.err)));
    }
  }
  calls_.erase(RequestId(call.id));
}

}  // namespace lockstep::host
