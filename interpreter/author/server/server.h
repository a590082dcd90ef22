// `lockstep lsp`: a server of the Language Server Protocol 3.17.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "author/server/analysis_thread.h"
#include "author/server/connection.h"
#include "author/server/diagnostics_json.h"
#include "author/server/features/feature.h"
#include "author/server/workspace.h"

namespace lockstep::host {

class Server {
 public:
  // `settings` are those of the command line; those of the editor are added to them.
  Server(Settings settings, int input, int output);

  // 0 after `shutdown` and the end of the session, else 1, as the protocol says.
  int run();
  // Why the client was not understood, or "".
  const std::string& problem() const { return connection_.problem(); }

 private:
  using Answer = Json (Server::*)(Message&);
  using Take = void (Server::*)(Message&);
  static Answer answer_of(std::string_view method);
  static Take take_of(std::string_view method);

  void handle(Message message);
  void handle_request(Message& message);
  void handle_notification(Message& message);
  // Nothing: it waits for an analysis.
  std::optional<Json> ask(const Feature& feature, Message& message);
  void ask_again();

  Json initialize(Message& message);
  Json shutdown(Message& message);
  void initialized(Message& message);
  void cancel(Message& message);
  void open(Message& message);
  void change(Message& message);
  void close(Message& message);
  void look_again(Message& message);
  void configure(Message& message);

  void use(const ClientParams& client);
  void post_jobs();
  void take_analyses();
  enum class Tell : bool { Changes, Always };
  void publish(const std::string& checked, Tell tell);
  void say_untrusted();

  const Settings own_;  // of the command line
  std::shared_ptr<const Settings> settings_;
  ClientParams client_;
  Connection connection_;
  Workspace workspace_;
  std::deque<Message> waiting_;                    // requests, for an analysis
  std::map<std::string, DiagnosticsByUri> found_;  // by the URI of the file that was checked
  std::map<std::string, std::string> published_;   // what the client has, by URI
  std::uint64_t serial_ = 0;                       // of the last job
  bool is_initialized_ = false, is_shut_down_ = false, has_exit_ = false, said_untrusted_ = false;
  AnalysisThread analyses_;
};

}  // namespace lockstep::host
