#include "groot/message.h"

#include <sys/random.h>

#include <stdexcept>
#include <utility>

namespace lockstep::host {
namespace {

constexpr char kProtocol = 2;
constexpr std::size_t kHeader = 6;  // bytes: protocol, request, id

}  // namespace

void append_number(std::string& to, std::uint64_t number, unsigned count) {
  for (unsigned byte = 0; byte < count; ++byte) to += static_cast<char>(number >> (8 * byte));
}

// Another version of the protocol is answered in this one, as the library does.
std::optional<GrootHeader> read_groot_header(std::string_view bytes) {
  if (bytes.size() != kHeader) return std::nullopt;
  std::uint32_t id = 0;
  for (std::size_t byte = kHeader; byte-- > 2;) {
    id = id << 8 | static_cast<unsigned char>(bytes[byte]);
  }
  return GrootHeader{static_cast<GrootRequest>(bytes[1]), id};
}

std::string to_bytes(GrootHeader header) {
  std::string bytes{kProtocol, static_cast<char>(header.request)};
  append_number(bytes, header.id, 4);
  return bytes;
}

// Makes an identifier of version 4 (RFC 9562).
GrootTreeId make_groot_tree_id() {
  GrootTreeId id{};
  if (getrandom(id.data(), id.size(), 0) != static_cast<ssize_t>(id.size())) {
    throw std::runtime_error("the system gives no random numbers");
  }
  id[6] = static_cast<char>((id[6] & 0x0f) | 0x40);
  id[8] = static_cast<char>((id[8] & 0x3f) | 0x80);
  return id;
}

std::string reply_header(GrootHeader request, const GrootTreeId& tree) {
  return to_bytes(request).append(tree.data(), tree.size());
}

GrootMessage groot_error(std::string text) {
  return {"error", std::move(text)};
}

}  // namespace lockstep::host
