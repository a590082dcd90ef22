// Where a run waits to be asked for something: a socket that only its user can reach. A request is
// one packet, and so is the answer. An order to the run, or a question about it, is JSON; anything
// else is an address for listen_on_resolved, where a monitor is wanted. Names are looked up by the
// one who asks, so that no run waits for a name server.
#pragma once

#include <functional>
#include <string>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"

namespace lockstep::host {

class AttachSocket {
 public:
  // A socket that a run has left there is replaced; nothing else is.
  static Result<AttachSocket> at(const std::string& path);
  AttachSocket(AttachSocket&&) = default;
  AttachSocket& operator=(AttachSocket&&) = delete;
  ~AttachSocket();

  // Can be read when somebody asks.
  int descriptor() const { return socket_.number(); }
  // Answers the one who has asked.
  void answer(const std::function<Result<std::string>(const std::string& request)>& answer);

 private:
  AttachSocket(FileDescriptor socket, std::string path)
      : socket_(std::move(socket)), path_(std::move(path)) {}

  FileDescriptor socket_;
  std::string path_;
};

// What the run at this socket answers to a request.
Result<std::string> ask_run(const std::string& path, const std::string& request);

// Asks the run at this socket for a monitor, and gives its link. A run that has one already keeps
// it.
Result<std::string> attach(const std::string& path, const std::string& address);

}  // namespace lockstep::host
