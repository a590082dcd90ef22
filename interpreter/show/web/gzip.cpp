#include "show/web/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>

namespace lockstep::host {

struct Gzip::State {
  z_stream stream{};
  std::array<char, 1u << 16u> part;
};

Gzip::Gzip(Sink sink) : sink_(std::move(sink)), state_(std::make_unique<State>()) {
  constexpr int kWindow = 15, kGzip = 16, kMemory = 8;
  if (deflateInit2(&state_->stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow + kGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

Gzip::~Gzip() {
  deflateEnd(&state_->stream);
}

void Gzip::add(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto length = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max() / 2);
    compress(bytes.substr(0, length), false);
    bytes.remove_prefix(length);
  }
}

void Gzip::finish() {
  compress({}, true);
}

void Gzip::compress(std::string_view bytes, bool is_end) {
  auto& [stream, part] = *state_;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  do {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    deflate(&stream, is_end ? Z_FINISH : Z_NO_FLUSH);
    sink_({part.data(), part.size() - stream.avail_out});
  } while (stream.avail_out == 0);  // else it has taken all bytes
}

}  // namespace lockstep::host
