// The two ZeroMQ sockets of Groot2's protocol: one that is asked and answers, and one that tells
// whoever listens. For one thread. The only file that knows ZeroMQ.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "base/system/file_descriptor.h"
#include "groot/message.h"

namespace lockstep::host {

class GrootSockets {
 public:
  // Takes sockets that listen already. Starts the threads of ZeroMQ.
  GrootSockets(FileDescriptor requests, FileDescriptor events);
  // Gives messages that were sent a moment to go out.
  ~GrootSockets();
  GrootSockets(GrootSockets&&) noexcept;
  GrootSockets& operator=(GrootSockets&&) noexcept;

  // Waits until there is a request, or `wake` can be read, or for `longest`. A request must be
  // answered before the next one.
  std::optional<GrootMessage> receive(int wake, std::chrono::milliseconds longest);
  void reply(const GrootMessage& message);
  void publish(const GrootMessage& message);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep::host
