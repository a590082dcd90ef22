#include "record/use/mcap_stream.h"

#include <chrono>
#include <istream>
#include <optional>
#include <stdexcept>
#include <streambuf>
#include <utility>

#include "base/core/clock.h"
#include "record/read/recording_reader.h"
#include "record/use/mcap_messages.h"

namespace lockstep::host {
namespace {

constexpr Nanoseconds kLongestChunk = std::chrono::seconds(1);

// Whole lines, which come one after the other: at its end, there may be more later.
class Lines final : public std::streambuf {
 public:
  // Nothing may be left of what was there before.
  void set(std::string text) {
    text_ = std::move(text);
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

 private:
  std::string text_;
};

class McapStream final : public TextEncoder {
 public:
  McapStream(McapTimes times, std::shared_ptr<std::optional<double>> start)
      : times_(times), start_(std::move(start)) {}

  std::string add(std::string_view text) override {
    unread_ += text;
    if (const auto end = unread_.rfind('\n'); end != std::string::npos) read_lines(end + 1);
    if (messages_ && monotonic_now() - chunk_began_ >= kLongestChunk) end_chunk();
    return std::exchange(bytes_, {});
  }

  std::string end() override {
    if (messages_) messages_->finish(reader_->end());
    return std::exchange(bytes_, {});
  }

 private:
  void read_lines(std::size_t count) {
    std::string rest = unread_.substr(count);
    unread_.resize(count);
    lines_.set(std::exchange(unread_, std::move(rest)));
    in_.clear();
    if (!reader_) begin();
    while (const auto tick = reader_->next()) messages_->take(*tick);
    check();
  }

  void begin() {
    reader_.emplace(in_, "its text");
    check();
    messages_.emplace(reader_->header(), start_time(), sink_);
    end_chunk();
  }

  void check() const {
    if (!reader_->error().empty()) throw std::runtime_error(reader_->error());
  }

  double start_time() const {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const bool has_date = times_ == McapTimes::SinceEpoch;
    if (!*start_) *start_ = has_date ? std::chrono::duration<double>(now).count() : 0;
    return **start_;
  }

  void end_chunk() {
    messages_->flush();
    chunk_began_ = monotonic_now();
  }

  const McapTimes times_;
  const std::shared_ptr<std::optional<double>> start_;
  std::string unread_, bytes_;
  const ExportSink sink_ = [this](std::string_view bytes) {
    bytes_ += bytes;
    return true;
  };
  Lines lines_;
  std::istream in_{&lines_};
  std::optional<RecordingReader> reader_;
  std::optional<McapMessages> messages_;
  Nanoseconds chunk_began_{0};
};

}  // namespace

MakeEncoder mcap_encoder(McapTimes times) {
  return [times, start = std::make_shared<std::optional<double>>()] {
    return std::make_unique<McapStream>(times, start);
  };
}

}  // namespace lockstep::host
