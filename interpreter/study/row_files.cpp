// The rows of a study, plain and compressed.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/compression/whole_frame.h"
#include "base/system/descriptors.h"
#include "study/result_file.h"
#include "study/row_reader.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kFrame = 256u << 10u;  // bytes of text, at least, in all frames but the last

class PlainRows : public ResultFile {
 public:
  explicit PlainRows(const ResultPlace& place) : place_(place) {}

  Result<RowSequence> take_over() override {
    RowReader reader(path(), place_.plan);
    while (!reader.next().empty()) continue;
    if (!reader.error().empty()) return problem(reader.error());
    return cut(reader)
        .and_then([&] { return reader.bytes() == 0 ? add(row_header(place_.plan), {}) : Done(); })
        .map([&] { return reader.rows(); });
  }
  Result<void> add(std::string_view lines, std::span<const RowResult>) override {
    return append(lines);
  }

 protected:
  using Done = Result<void>;

  std::string path() const {
    return fmt::format("{}/{}", place_.directory, result_file_name(place_.plan.rows));
  }
  const ResultPlace& place() const { return place_; }
  // The rows behind those that were read.
  virtual Result<void> cut(const RowReader& read) { return cut_at(read.bytes()); }
  Result<void> append(std::string_view bytes) {
    return write_all(place_.file, bytes) ? Done() : cannot_write();
  }
  Result<void> cut_at(std::uint64_t size) {
    return ftruncate(place_.file, static_cast<off_t>(size)) == 0 ? Done() : cannot_write();
  }
  tl::unexpected<Problem> cannot_write() const {
    return problem(fmt::format("cannot write '{}': {}", path(), std::strerror(errno)));
  }

 private:
  ResultPlace place_;
};

// Frames of zstd that each end with a row. All but the last have at least kFrame of text, so that
// the bytes depend on the rows alone.
class CompressedRows final : public PlainRows {
 public:
  using PlainRows::PlainRows;

  Result<RowSequence> take_over() override {
    return find_frames().and_then([&] { return PlainRows::take_over(); });
  }

  Result<void> add(std::string_view lines, std::span<const RowResult>) override {
    Result<void> written;
    while (!lines.empty() && written) {
      const auto line = lines.substr(0, lines.find('\n') + 1);
      text_ += line;
      lines.remove_prefix(line.size());
      if (text_.size() >= kFrame) written = write_frame().map([&] { close_frame(); });
    }
    return written;
  }

  // Saves the last frame as it is so far.
  Result<void> save() override { return text_.size() == text_in_file_ ? Done() : write_frame(); }

 private:
  // The rows that were read end with a frame.
  Result<void> cut(const RowReader& read) override {
    if (read.bytes() == text_before_ + text_.size()) return {};
    return problem(fmt::format("'{}' is damaged: a row is not whole", path()));
  }
  // In place of the last frame, if it is there already.
  Result<void> write_frame() {
    const std::string frame = zstd_frame(text_);
    const auto written =
        (text_in_file_ == 0 ? Done() : cut_at(end_)).and_then([&] { return append(frame); });
    text_in_file_ = text_.size();
    size_ = frame.size();
    return written;
  }
  void close_frame() {
    end_ += size_;
    text_.clear();
    text_in_file_ = 0;
  }

  Result<void> find_frames();

  std::uint64_t end_ = 0;          // of the frames before the last
  std::uint64_t text_before_ = 0;  // in them
  std::string text_;               // of the last one
  std::size_t text_in_file_ = 0;   // so much of it
  std::uint64_t size_ = 0;         // of the last one in the file
};

// Cuts off a frame that a kill has cut, and goes on with the last one if it is short.
Result<void> CompressedRows::find_frames() {
  std::string window(4 * kFrame, '\0');
  while (true) {
    const ssize_t count =
        pread(place().file, window.data(), window.size(), static_cast<off_t>(end_));
    if (count < 0)
      return problem(fmt::format("cannot read '{}': {}", path(), std::strerror(errno)));
    const auto bytes = std::string_view(window).substr(0, static_cast<std::size_t>(count));
    const auto frame = first_frame(bytes);
    if (!frame && bytes.size() == window.size())
      return problem(fmt::format("'{}' is damaged at byte {}", path(), end_));
    if (!frame) return cut_at(end_);
    if (frame->text < kFrame) {
      text_ = frame_text(bytes.substr(0, frame->file), frame->text);
      text_in_file_ = text_.size();
      return cut_at(end_ + frame->file);
    }
    end_ += frame->file;
    text_before_ += frame->text;
  }
}

}  // namespace

std::unique_ptr<ResultFile> plain_rows(const ResultPlace& place) {
  return std::make_unique<PlainRows>(place);
}

std::unique_ptr<ResultFile> compressed_rows(const ResultPlace& place) {
  return std::make_unique<CompressedRows>(place);
}

}  // namespace lockstep::host
