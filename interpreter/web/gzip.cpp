#include "web/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>

namespace lockstep::host {

std::string gzip(std::string_view bytes) {
  constexpr int kWindow = 15, kGzip = 16, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow + kGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string result;
  std::array<char, 1u << 16u> part;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    const auto length = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max() / 2);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(length);
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = deflate(&stream, length == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    bytes.remove_prefix(length - stream.avail_in);
    result.append(part.data(), part.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return result;
}

}  // namespace lockstep::host
