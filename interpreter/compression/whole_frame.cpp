#include "compression/whole_frame.h"

#include <stdexcept>

#include "compression/zstd_library.h"

namespace lockstep::host {

std::string zstd_frame(std::string_view text) {
  constexpr int kFast = 1;
  std::string frame(zstd().compress_bound(text.size()), '\0');
  const std::size_t size =
      zstd().compress_whole(frame.data(), frame.size(), text.data(), text.size(), kFast);
  if (zstd().is_error(size) != 0) throw std::runtime_error(zstd().error_name(size));
  frame.resize(size);
  return frame;
}

}  // namespace lockstep::host
