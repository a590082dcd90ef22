// The messages between a client, as an editor, and the server, over two descriptors.
#pragma once

#include <deque>
#include <set>
#include <string>

#include "author/server/protocol/frames.h"
#include "author/server/protocol/message.h"

namespace lockstep::host {

// What a protocol on top of JSON-RPC says.
struct RpcProtocol {
  Framing framing;
  std::string_view cancel;     // the notification that takes back a request
  std::string_view cancelled;  // its field with the id of that
};
inline constexpr RpcProtocol kLanguageServerProtocol{Framing::Headers, "$/cancelRequest", "id"};

class Connection {
 public:
  Connection(int input, int output, const RpcProtocol& protocol)
      : input_(input), output_(output), protocol_(protocol), frames_(protocol.framing) {}

  // Waits for a message or a signal, or until `other` can be read, or not at all if there is
  // something to do.
  enum class Wait : bool { No, Yes };
  void receive(int other, Wait wait);
  bool has_message() const { return !messages_.empty(); }
  Message take();
  JsonReader& reader() { return reader_; }
  // Whether the client has taken back the request. Then it is forgotten.
  bool was_cancelled(const RequestId& id) { return cancelled_.erase(id) > 0; }

  void send(const std::string& message);
  // The client is gone, or nobody can understand it.
  bool is_over() const { return is_over_; }
  // Why nobody can; "" while it is understood.
  const std::string& problem() const { return problem_; }

 private:
  void read_some();
  void accept(std::string body);

  int input_, output_;
  const RpcProtocol& protocol_;
  FrameReader frames_;
  JsonReader reader_;
  std::deque<Message> messages_;
  std::set<RequestId> cancelled_;
  bool is_over_ = false;
  std::string problem_;
};

}  // namespace lockstep::host
