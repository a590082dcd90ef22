#include "base/compression/decompressed.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/compression/seek_table.h"
#include "base/compression/zstd_library.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kPart = 64u << 10;  // bytes
// Text up to here is given when its whole frame was right, which its checksum says. That is more
// than the frames of recordings have; of longer ones, other programs', a reader gets what comes.
constexpr std::size_t kWhole = 512u << 10;
constexpr std::string_view kMagic{"\x28\xB5\x2F\xFD", 4};
constexpr std::size_t kFrameHeader = 6;     // bytes, which all frames of a recording share
constexpr std::size_t kTaken = 512u << 10;  // more than a frame of a recording
constexpr int kMostWindow = 25;             // as a power of two, in bytes: the memory of a reader
// A text that is longer than kAlways may be so many times as long as the file, far more than
// recordings are: a small file must not cost much memory or time.
constexpr std::uint64_t kMostTimes = 256, kAlways = 16u << 20;

}  // namespace

struct Decompressed::Decompressor {
  ZSTD_DCtx* context = zstd().create_reader();
  bool in_frame = false;
  std::string header, taken;  // the first bytes of the frame, and the last ones that it has taken

  void begin_frame() {
    header.clear();
    taken.clear();
  }
  void take(std::string_view bytes) {
    header += bytes.substr(0, kFrameHeader - header.size());
    taken += bytes;
    if (taken.size() > 2 * kTaken) taken.erase(0, taken.size() - kTaken);
  }
  // Whether the file goes on where the frame, which is not at its end, should have ended: with the
  // table, or with a frame that begins as this one. A file that is cut does not.
  bool is_too_long() const {
    const std::string_view all = taken;
    const bool has_table = all.size() >= kSeekFooter &&
                           seek_table_size(all.substr(all.size() - kSeekFooter)).has_value();
    const auto again = all.rfind(header);
    const bool has_other = header.size() == kFrameHeader && again != 0 && again != all.npos;
    return has_table || has_other;
  }

  Decompressor() { zstd().set_reader(context, ZSTD_d_windowLogMax, kMostWindow); }
  ~Decompressor() { zstd().free_reader(context); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;
};

Decompressed::Decompressed(std::streambuf& file) : file_(file), bytes_(kPart) {}
Decompressed::~Decompressed() = default;

Decompressed::int_type Decompressed::underflow() {
  if (!has_looked_) look();
  const bool is_filled = zstd_ ? fill_compressed() : fill_plain();
  return is_filled ? traits_type::to_int_type(*gptr()) : traits_type::eof();
}

void Decompressed::look() {
  has_looked_ = true;
  // A pipe may give a byte at a time.
  while (count_ < kMagic.size() && read_file()) {
  }
  if (!std::string_view(bytes_.data(), count_).starts_with(kMagic)) return;
  zstd_ = std::make_unique<Decompressor>();
  text_.resize(kWhole);
}

// More bytes behind those that are not used yet. False: there are none.
bool Decompressed::read_file() {
  if (at_ == count_) at_ = count_ = 0;
  if (count_ == bytes_.size()) return false;
  const auto count = file_.sgetn(bytes_.data() + count_, 1);
  if (count <= 0) return false;
  const auto room = static_cast<std::streamsize>(bytes_.size() - count_ - 1);
  const auto there = std::clamp<std::streamsize>(file_.in_avail(), 0, room);
  const auto more = file_.sgetn(bytes_.data() + count_ + 1, there);
  count_ += 1 + static_cast<std::size_t>(std::max<std::streamsize>(more, 0));
  file_end_ += 1 + static_cast<std::uint64_t>(std::max<std::streamsize>(more, 0));
  return true;
}

bool Decompressed::fill_plain() {
  if (at_ == count_ && !read_file()) return false;
  setg(bytes_.data(), bytes_.data() + at_, bytes_.data() + count_);
  text_end_ += count_ - at_;
  at_ = count_;
  return true;
}

// A pipe that has no more bytes now gives what there is of a frame: somebody may watch a run.
bool Decompressed::fill_compressed() {
  std::size_t filled = 0;
  while (filled < text_.size()) {
    const bool waits = filled > 0 && at_ == count_ && file_.in_avail() <= 0;
    if (waits) break;
    if (at_ == count_ && !read_file()) {
      if (!zstd_->in_frame || !zstd_->is_too_long()) break;
      throw CannotDecompress(fmt::format(
          "its compressed bytes from {} on are damaged (a frame is too long)", frame_begin_));
    }
    if (!zstd_->in_frame) {
      zstd_->begin_frame();
      frame_begin_ = file_end_ - (count_ - at_);
      const Frame frame{text_end_, frame_begin_};
      if (frames_.empty() || frames_.back().text < frame.text) frames_.push_back(frame);
    }
    ZSTD_inBuffer in{bytes_.data(), count_, at_};
    ZSTD_outBuffer out{text_.data(), text_.size(), filled};
    const std::size_t left = zstd().decompress(zstd_->context, &out, &in);
    if (zstd().is_error(left) != 0) {
      throw CannotDecompress(fmt::format("its compressed bytes from {} on are damaged ({})",
                                         frame_begin_, zstd().error_name(left)));
    }
    zstd_->take({bytes_.data() + at_, in.pos - at_});
    at_ = in.pos;
    const std::uint64_t used = file_end_ - (count_ - at_);
    filled = out.pos;
    if (text_end_ + filled > kAlways + kMostTimes * used) {
      throw CannotDecompress(
          fmt::format("before byte {}, it has more than {} times as much text as bytes, which no "
                      "recording has",
                      used, kMostTimes));
    }
    zstd_->in_frame = left != 0;
    if (!zstd_->in_frame && filled > 0) break;
  }
  if (filled == 0) return false;
  setg(text_.data(), text_.data(), text_.data() + filled);
  text_end_ += filled;
  if (!zstd_->in_frame) check_frame();
  return true;
}

// Behind a frame. A damaged table would lead to another place.
void Decompressed::check_frame() const {
  if (!has_table_ || text_end_ == *size_) return;
  if (std::ranges::binary_search(frames_, text_end_, {}, &Frame::text)) return;
  throw CannotDecompress(fmt::format(
      "the table of its frames is damaged: none ends at byte {} of the text", text_end_));
}

Decompressed::pos_type Decompressed::seekoff(off_type offset, std::ios_base::seekdir way,
                                             std::ios_base::openmode which) {
  if (way == std::ios_base::cur && offset == 0) {
    return static_cast<off_type>(text_position());
  }
  if (way == std::ios_base::end && offset == 0) {
    const auto size = text_size();
    return size ? seekpos(static_cast<off_type>(*size), which) : pos_type(off_type(-1));
  }
  if (way != std::ios_base::beg || offset < 0) return pos_type(off_type(-1));
  return seekpos(offset, which);
}

Decompressed::pos_type Decompressed::seekpos(pos_type position, std::ios_base::openmode) {
  const auto text = static_cast<std::uint64_t>(off_type(position));
  if (!has_looked_) look();
  if (!go_to_frame(text)) return pos_type(off_type(-1));
  // The rest of the way within the frame, or through a plain file.
  while (text_end_ < text) {
    if (underflow() == traits_type::eof()) return pos_type(off_type(-1));
  }
  setg(eback(), egptr() - (text_end_ - text), egptr());
  return position;
}

// Without a table, as behind a run that was killed, all of the text is read once.
std::optional<std::uint64_t> Decompressed::text_size() {
  if (!has_looked_) look();
  if (!zstd_) {
    const auto end = off_type(file_.pubseekoff(0, std::ios_base::end, std::ios_base::in));
    return end < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(end));
  }
  if (!size_ && !read_table()) {
    if (!go_to_frame(frames_.empty() ? 0 : frames_.back().text)) return std::nullopt;
    while (fill_compressed()) {
    }
    size_ = text_end_;
  }
  return size_;
}

// False: there is none.
bool Decompressed::read_table() {
  const auto read_at = [this](std::uint64_t at, std::size_t count) {
    std::string bytes(count, '\0');
    if (off_type(file_.pubseekpos(static_cast<off_type>(at), std::ios_base::in)) < 0) bytes.clear();
    bytes.resize(static_cast<std::size_t>(
        file_.sgetn(bytes.data(), static_cast<std::streamsize>(bytes.size()))));
    return bytes;
  };
  const auto end = off_type(file_.pubseekoff(0, std::ios_base::end, std::ios_base::in));
  if (end < static_cast<off_type>(kSeekFooter)) return false;
  const auto file_size = static_cast<std::uint64_t>(end);
  const auto size = seek_table_size(read_at(file_size - kSeekFooter, kSeekFooter));
  if (!size || *size > file_size) return false;
  const auto table = read_seek_table(read_at(file_size - *size, *size));
  if (!table) return false;
  std::vector<Frame> frames;
  Frame next;
  for (const FrameSize& it : *table) {
    if (it.text > 0) frames.push_back(next);
    next.text += it.text;
    next.file += it.file;
  }
  // A table that is of other frames is none.
  if (next.file != file_size - *size) return false;
  frames_ = std::move(frames);
  size_ = next.text;
  has_table_ = true;
  return true;
}

// To the beginning of the last frame that begins before this place of the text; in a plain file, to
// the place.
bool Decompressed::go_to_frame(std::uint64_t text) {
  Frame frame{text, text};
  if (zstd_) {
    const auto after = std::ranges::upper_bound(frames_, text, {}, &Frame::text);
    frame = after == frames_.begin() ? Frame() : *std::prev(after);
  }
  const auto there = file_.pubseekpos(static_cast<std::streamoff>(frame.file), std::ios_base::in);
  if (there == pos_type(off_type(-1))) return false;
  if (zstd_) {
    zstd().reset_reader(zstd_->context, ZSTD_reset_session_only);
    zstd_->in_frame = false;
  }
  setg(nullptr, nullptr, nullptr);
  at_ = count_ = 0;
  file_end_ = frame.file;
  text_end_ = frame.text;
  return true;
}

}  // namespace lockstep::host
