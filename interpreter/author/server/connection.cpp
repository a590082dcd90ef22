#include "author/server/connection.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "base/system/descriptors.h"

namespace lockstep::host {

void Connection::receive(int other, Wait wait) {
  do {
    pollfd files[] = {{input_, POLLIN, 0}, {other, POLLIN, 0}};
    const bool may_wait = wait == Wait::Yes && messages_.empty();
    const int ready = ::poll(files, 2, may_wait ? -1 : 0);
    if (ready <= 0 || files[0].revents == 0) return;
    read_some();
  } while (!is_over_);
}

void Connection::read_some() {
  static constexpr std::size_t kChunk = 1u << 16u;
  std::string bytes(kChunk, '\0');
  const auto count = ::read(input_, bytes.data(), bytes.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (count <= 0) {
    is_over_ = true;
    return;
  }
  frames_.add(std::string_view(bytes).substr(0, static_cast<std::size_t>(count)));
  while (true) {
    auto body = frames_.next();
    if (!body) {
      problem_ = body.error().message;
      is_over_ = true;
      return;
    }
    if (!*body) return;
    accept(**std::move(body));
  }
}

void Connection::accept(std::string body) {
  try {
    Message message = read_message(reader_, std::move(body));
    if (message.method == protocol_.cancel) {
      const RequestId id = cancelled_id(reader_, message, protocol_.cancelled);
      const bool waits =
          std::ranges::any_of(messages_, [&](const Message& it) { return it.id == id; });
      if (waits) {
        cancelled_.insert(id);
        return;
      }
    }
    messages_.push_back(std::move(message));
  } catch (const NotJson& error) {
    send(refusal({}, RpcError::ParseError, error.what()));
  } catch (const JsonError& error) {
    send(refusal({}, RpcError::InvalidRequest, error.what()));
  }
}

Message Connection::take() {
  Message message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

void Connection::send(const std::string& message) {
  if (!write_all(output_, framed(message, protocol_.framing))) is_over_ = true;
}

}  // namespace lockstep::host
