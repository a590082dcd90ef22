// `lockstep mcp`: a server of the Model Context Protocol.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "author/server/connection.h"
#include "base/system/mutex.h"
#include "base/system/pipe.h"
#include "cli/tools/mcp/tool_process.h"
#include "cli/tools/mcp/tools.h"

namespace lockstep::host {

class McpServer {
 public:
  // The working directory is the workspace.
  McpServer(ToolFolders folders, int input, int output);
  ~McpServer();
  McpServer(const McpServer&) = delete;
  McpServer& operator=(const McpServer&) = delete;

  // Until the client has closed stdin, or a signal.
  void run();
  // Why the client was not understood, or "".
  const std::string& problem() const { return connection_.problem(); }

 private:
  using Answer = Json (McpServer::*)(Message&);
  static Answer answer_of(std::string_view method);

  // A call of a tool, from its request to its answer.
  struct Call {
    RequestId id = {};
    const Tool* tool = nullptr;
    ToolCommand command = {};
    std::optional<Json> token = {};  // none: the client wants no notes of progress
    std::filesystem::path folder = {};
    ToolProcess process = {};
    std::thread thread = {};
    bool is_cancelled = false;
  };
  // What the thread of a call has to say.
  struct Event {
    RequestId id;
    bool is_end = false;
    ToolOutcome outcome = {};
    double seconds = 0;
    std::string line = {};
  };

  void handle(Message message);
  void handle_request(Message& message);
  Json initialize(Message& message);
  Json ping(Message& message);
  Json list_tools(Message& message);
  Json all_resources(Message& message);
  Json no_templates(Message& message);
  Json one_resource(Message& message);
  void call_tool(Message& message);
  void cancel(Message& message);

  void start_calls();
  void start(Call& call);
  void post(Event event);
  void take_events();
  void end(Call& call, ToolOutcome outcome);

  const ToolFolders folders_;
  Connection connection_;
  bool is_initialized_ = false;
  std::uint64_t calls_made_ = 0;
  std::deque<RequestId> waiting_;
  std::map<RequestId, std::unique_ptr<Call>> calls_;  // running or waiting
  Pipe wake_;
  Mutex mutex_;
  std::vector<Event> events_ LOCKSTEP_GUARDED_BY(mutex_);
};

}  // namespace lockstep::host
