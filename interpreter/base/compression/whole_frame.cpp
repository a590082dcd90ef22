#include "base/compression/whole_frame.h"

#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

#include "base/compression/zstd_library.h"

namespace lockstep::host {

namespace {

constexpr std::size_t kChecksum = 4;  // bytes

}  // namespace

std::string zstd_frame(std::string_view text) {
  constexpr int kFast = 1;
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> writer(zstd().create_writer(),
                                                                       zstd().free_writer);
  if (writer == nullptr) throw std::bad_alloc();
  zstd().set_parameter(writer.get(), ZSTD_c_compressionLevel, kFast);
  zstd().set_parameter(writer.get(), ZSTD_c_checksumFlag, 1);
  std::string frame(zstd().compress_bound(text.size()) + kChecksum, '\0');
  const std::size_t size =
      zstd().compress_whole(writer.get(), frame.data(), frame.size(), text.data(), text.size());
  if (zstd().is_error(size) != 0) throw std::runtime_error(zstd().error_name(size));
  frame.resize(size);
  return frame;
}

std::optional<FrameSize> first_frame(std::string_view bytes) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const std::size_t file = zstd().frame_size(bytes.data(), bytes.size());
  if (zstd().is_error(file) != 0 || file > kMost) return std::nullopt;
  const std::uint64_t text = zstd().text_size(bytes.data(), bytes.size());
  // The two largest numbers say that the size is not known.
  if (text > kMost) return std::nullopt;
  return FrameSize{static_cast<std::uint32_t>(file), static_cast<std::uint32_t>(text)};
}

std::string frame_text(std::string_view frame, std::size_t size) {
  std::string text(size, '\0');
  const std::size_t got =
      zstd().decompress_whole(text.data(), text.size(), frame.data(), frame.size());
  if (zstd().is_error(got) != 0 || got != size) text.clear();
  return text;
}

}  // namespace lockstep::host
