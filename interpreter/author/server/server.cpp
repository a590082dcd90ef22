#include "author/server/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <utility>

#include "base/core/version.h"
#include "base/core/wording.h"

namespace lockstep::host {

Server::Server(Settings settings, int input, int output)
    : own_(std::move(settings)),
      settings_(std::make_shared<const Settings>(own_)),
      connection_(input, output, kLanguageServerProtocol) {}

Server::Answer Server::answer_of(std::string_view method) {
  if (method == "initialize") return &Server::initialize;
  return method == "shutdown" ? &Server::shutdown : nullptr;
}

Server::Take Server::take_of(std::string_view method) {
  struct Row {
    std::string_view method;
    Take take;
  };
  static constexpr Row kRows[] = {
      {"initialized", &Server::initialized},
      {"$/cancelRequest", &Server::cancel},
      {"textDocument/didOpen", &Server::open},
      {"textDocument/didChange", &Server::change},
      {"textDocument/didClose", &Server::close},
      {"textDocument/didSave", &Server::look_again},
      {"workspace/didChangeWatchedFiles", &Server::look_again},
      {"workspace/didChangeConfiguration", &Server::configure},
  };
  const auto* const row = std::ranges::find(kRows, method, &Row::method);
  return row == std::end(kRows) ? nullptr : row->take;
}

int Server::run() {
  while (!has_exit_) {
    if (!connection_.is_over()) connection_.receive(analyses_.wakes(), Connection::Wait::Yes);
    if (connection_.has_message()) {
      handle(connection_.take());
    } else if (connection_.is_over()) {
      break;
    }
    take_analyses();
    // Only the newest text counts.
    if (!connection_.has_message()) post_jobs();
  }
  return is_shut_down_ ? 0 : 1;
}

void Server::handle(Message message) {
  if (message.method.empty()) return;  // an answer: nothing depends on it
  if (message.method == "exit") {
    has_exit_ = true;
    return;
  }
  message.is_request() ? handle_request(message) : handle_notification(message);
}

void Server::handle_request(Message& message) {
  const auto refuse = [&](RpcError error, std::string_view why) {
    connection_.send(refusal(message.id, error, why));
  };
  if (connection_.was_cancelled(message.id))
    return refuse(RpcError::RequestCancelled, "the request was canceled");
  if (!is_initialized_ && message.method != "initialize")
    return refuse(RpcError::NotInitialized, "the first request must be 'initialize'");
  if (is_shut_down_) return refuse(RpcError::InvalidRequest, "the server was shut down");
  try {
    if (const Answer function = answer_of(message.method)) {
      connection_.send(answer(message.id, (this->*function)(message)));
      return;
    }
    const auto all = features();
    const auto feature = std::ranges::find(all, message.method, &Feature::method);
    if (feature == all.end()) {
      return refuse(RpcError::MethodNotFound,
                    fmt::format("the method '{}' is unknown", brief(message.method)));
    }
    if (auto result = ask(*feature, message)) {
      connection_.send(answer(message.id, *std::move(result)));
    } else {
      waiting_.push_back(std::move(message));
    }
  } catch (const JsonError& error) {
    refuse(RpcError::InvalidParams, error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    refuse(RpcError::InternalError, error.what());
  }
}

// A notification that is not understood has no answer.
void Server::handle_notification(Message& message) {
  if (!is_initialized_ || is_shut_down_) return;
  const Take take = take_of(message.method);
  if (take == nullptr) return;
  try {
    (this->*take)(message);
  } catch (const JsonError& error) {
    Json params{{"type", 1},
                {"message", fmt::format("{}: {}", brief(message.method), error.what())}};
    connection_.send(notification("window/logMessage", std::move(params)));
  }
}

std::optional<Json> Server::ask(const Feature& feature, Message& message) {
  const FileParams params = read_file_params(connection_.reader(), message);
  const OpenFile* const file = workspace_.find(params.uri);
  if (file == nullptr) return Json();
  if (file->analysis == nullptr || (!feature.takes_older_analysis && !file->is_settled()))
    return std::nullopt;
  const auto is_settled = [](const auto& it) { return it.second.is_settled(); };
  if (feature.needs_all_files && !std::ranges::all_of(workspace_.files(), is_settled))
    return std::nullopt;
  return feature.answer({workspace_, *file, client_, params, *settings_});
}

void Server::ask_again() {
  auto waiting = std::exchange(waiting_, {});
  for (Message& message : waiting) handle_request(message);
}

Json Server::initialize(Message& message) {
  if (is_initialized_) throw JsonError("'initialize' comes once");
  client_ = read_client_params(connection_.reader(), message);
  is_initialized_ = true;
  use(client_);
  Json about{{"name", "lockstep"}, {"version", kVersion}};
  return {{"capabilities", capabilities()}, {"serverInfo", std::move(about)}};
}

Json Server::shutdown(Message&) {
  is_shut_down_ = true;
  for (const Message& it : std::exchange(waiting_, {}))
    connection_.send(refusal(it.id, RpcError::RequestCancelled, "the server was shut down"));
  return {};
}

// One that waits for an analysis; else it is over already.
void Server::cancel(Message& message) {
  const RequestId id =
      cancelled_id(connection_.reader(), message, kLanguageServerProtocol.cancelled);
  if (std::erase_if(waiting_, [&](const Message& it) { return it.id == id; }) == 0) return;
  connection_.send(refusal(id, RpcError::RequestCancelled, "the request was canceled"));
}

// Files that trees include, and plugins, may change without the editor.
void Server::initialized(Message&) {
  if (!client_.can_register_watchers) return;
  std::vector<Json> watchers;
  for (const char* files : {"**/*.xml", "**/*.so", "**/*.leaves.json"})
    watchers.push_back(Json{{"globPattern", files}});
  Json options{{"watchers", Json::array(std::move(watchers))}};
  std::vector<Json> all;
  all.push_back(Json{{"id", "files"},
                     {"method", "workspace/didChangeWatchedFiles"},
                     {"registerOptions", std::move(options)}});
  Json params{{"registrations", Json::array(std::move(all))}};
  connection_.send(request(1, "client/registerCapability", std::move(params)));
}

}  // namespace lockstep::host
