#include "base/compression/zstd_frames.h"

#include <algorithm>

#include "base/compression/xxh64.h"
#include "base/compression/zstd_library.h"

namespace lockstep::host {
namespace {

constexpr int kLevel = 1;  // higher levels need more time and give hardly fewer bytes

constexpr std::size_t kMoreRoom = 64;  // bytes, more than that of a frame and of its last block

// A block without content that is the last of its frame (RFC 8878, 3.1.1.2).
constexpr std::string_view kLastBlock{"\x01\0\0", 3};

ZSTD_CStream* stream(void* pointer) {
  return static_cast<ZSTD_CStream*>(pointer);
}

}  // namespace

ZstdFrames::ZstdFrames(std::size_t longest_piece)
    : workspace_(zstd().stream_size(kLevel)),
      bytes_(zstd().compress_bound(longest_piece) + kMoreRoom),
      text_(kFrame + longest_piece) {
  begin_frame();
  make_room();
}

void ZstdFrames::begin_frame() {
  stream_ = zstd().init_stream(workspace_.data(), workspace_.size());
  zstd().set_parameter(stream(stream_), ZSTD_c_compressionLevel, kLevel);
  zstd().set_parameter(stream(stream_), ZSTD_c_checksumFlag, 1);
}

void ZstdFrames::end_frame() {
  knows_sizes_ = knows_sizes_ && sizes_.size() < sizes_.capacity();
  if (knows_sizes_) sizes_.push_back(in_frame_);
  in_frame_ = {};
}

void ZstdFrames::make_room() {
  constexpr std::size_t kAhead = 64;
  if (sizes_.capacity() - sizes_.size() < kAhead) sizes_.reserve(2 * sizes_.size() + 2 * kAhead);
}

std::string_view ZstdFrames::add(std::string_view piece) {
  is_adding_ = true;
  const bool ends = in_frame_.text + piece.size() >= kFrame;
  ZSTD_inBuffer in{piece.data(), piece.size(), 0};
  ZSTD_outBuffer out{bytes_.data(), bytes_.size(), 0};
  // There is room for all of it, so one call is enough.
  zstd().compress(stream(stream_), &out, &in, ends ? ZSTD_e_end : ZSTD_e_flush);
  std::ranges::copy(piece, text_.begin() + in_frame_.text);
  in_frame_.text += static_cast<std::uint32_t>(piece.size());
  in_frame_.file += static_cast<std::uint32_t>(out.pos);
  if (ends) end_frame();
  is_adding_ = false;
  return {bytes_.data(), out.pos};
}

std::string_view ZstdFrames::end() {
  is_adding_ = false;
  begin_frame();
  if (in_frame_.text == 0) return {};
  const std::uint64_t sum = xxh64({text_.data(), in_frame_.text});
  auto end = std::ranges::copy(kLastBlock, bytes_.begin()).out;
  for (unsigned byte = 0; byte < 4; ++byte) *end++ = static_cast<char>(sum >> (8 * byte));
  const std::string_view bytes(bytes_.data(), static_cast<std::size_t>(end - bytes_.begin()));
  in_frame_.file += static_cast<std::uint32_t>(bytes.size());
  end_frame();
  return bytes;
}

std::string ZstdFrames::table() const {
  return knows_sizes_ ? seek_table(sizes_) : std::string();
}

}  // namespace lockstep::host
